// SPDX-License-Identifier: MIT
//
// gnomon-peer-ogre: the shared scenes by OGRE 1.12, its fixed-function OpenGL render system and its
// additive stencil shadows with their defaults: infinite far plane, volumes extruded by vertex
// programs, depth-fail only where OGRE finds that it needs it.
#include <OGRE/Ogre.h>
#include <fmt/format.h>

#include "gl_switch.hpp"
#include "mesh_pieces.hpp"
#include "peer.hpp"

namespace gnomon::peers {

namespace {

// Volumes name each vertex twice, as it is and extruded, in sixteen bits.
constexpr std::size_t vertices_a_piece = 32'000;
constexpr float beyond_all = 1e5F;

Ogre::Vector3 to_ogre(const glm::dvec3& v) {
    const glm::vec3 f(v);
    return {f.x, f.y, f.z};
}

Ogre::Quaternion rotation_of(const glm::dmat4& pose) {
    return {to_ogre(pose[0]), to_ogre(pose[1]), to_ogre(pose[2])};
}

class OgrePeer final : public Peer {
public:
    OgrePeer(const PeerScene& scene, Size size);

    void move_instance(std::size_t instance, const glm::dmat4& world_from_local) override;
    void move_light(std::size_t light, const glm::dvec4& position_world) override;
    Status draw(bool shadows, bool dry) override;
    Result<std::vector<std::byte>> picture() override {
        return read_back_buffer(size_.width, size_.height);
    }
    nlohmann::ordered_json describe() const override {
        return {{"engine", fmt::format("OGRE {}.{}.{} (additive stencil shadows)",
                                       OGRE_VERSION_MAJOR, OGRE_VERSION_MINOR, OGRE_VERSION_PATCH)},
                {"device", device_name()}};
    }

private:
    void open_window();
    void add_materials();
    void add_lights(const PeerScene& scene);
    void add_camera(const PeerScene& scene);

    Size size_;
    Ogre::LogManager log_;
    std::unique_ptr<Ogre::Root> root_;
    Ogre::RenderWindow* window_ = nullptr;
    Ogre::SceneManager* scene_manager_ = nullptr;
    std::vector<Ogre::SceneNode*> nodes_;
    std::vector<Ogre::SceneNode*> lights_;
};

template <class Buffer, class T>
void fill(Buffer& buffer, const std::vector<T>& values) {
    buffer->writeData(0, values.size() * sizeof(T), values.data(), true);
}

void add_piece(Ogre::Mesh& mesh, const MeshPiece& piece) {
    auto& buffers = Ogre::HardwareBufferManager::getSingleton();
    Ogre::SubMesh* part = mesh.createSubMesh();
    part->useSharedVertices = false;
    part->vertexData = new Ogre::VertexData;  // the submesh's from here on
    part->vertexData->vertexCount = piece.positions.size();
    const auto add_stream = [&](unsigned short source, Ogre::VertexElementSemantic semantic,
                                const std::vector<glm::vec3>& values) {
        part->vertexData->vertexDeclaration->addElement(source, 0, Ogre::VET_FLOAT3, semantic);
        auto buffer = buffers.createVertexBuffer(sizeof(glm::vec3), values.size(),
                                                 Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY, true);
        fill(buffer, values);
        part->vertexData->vertexBufferBinding->setBinding(source, buffer);
    };
    add_stream(0, Ogre::VES_POSITION, piece.positions);
    add_stream(1, Ogre::VES_NORMAL, piece.normals);
    auto indices =
        buffers.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_16BIT, piece.indices.size(),
                                  Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY, true);
    fill(indices, piece.indices);
    part->indexData->indexBuffer = indices;
    part->indexData->indexStart = 0;
    part->indexData->indexCount = piece.indices.size();
}

Ogre::MeshPtr make_mesh(const PeerMesh& source, const std::string& name) {
    Ogre::MeshPtr mesh =
        Ogre::MeshManager::getSingleton().createManual(name, Ogre::RGN_DEFAULT, nullptr);
    for (const MeshPiece& piece : split_mesh(source, vertices_a_piece)) add_piece(*mesh, piece);
    Ogre::AxisAlignedBox box;
    for (const glm::vec3& p : source.positions) box.merge(Ogre::Vector3(p.x, p.y, p.z));
    mesh->_setBounds(box, false);
    mesh->_setBoundingSphereRadius(box.getHalfSize().length());
    mesh->load();
    return mesh;
}

OgrePeer::OgrePeer(const PeerScene& scene, Size size) : size_(size) {
    open_window();
    scene_manager_ = root_->createSceneManager();
    // Before meshes are made: they are prepared for volumes as they are loaded.
    scene_manager_->setShadowTechnique(Ogre::SHADOWTYPE_STENCIL_ADDITIVE);
    scene_manager_->setAmbientLight(Ogre::ColourValue(0.15F, 0.15F, 0.15F));
    add_materials();
    std::vector<Ogre::MeshPtr> meshes;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        meshes.push_back(make_mesh(scene.meshes[i], "mesh " + std::to_string(i)));
    for (const Instance& instance : scene.instances) {
        Ogre::Entity* entity = scene_manager_->createEntity(meshes[instance.mesh]);
        entity->setMaterialName(instance.casts ? "caster" : "ground");
        entity->setCastShadows(instance.casts);
        nodes_.push_back(scene_manager_->getRootSceneNode()->createChildSceneNode());
        nodes_.back()->attachObject(entity);
        move_instance(nodes_.size() - 1, instance.world_from_local);
    }
    add_lights(scene);
    add_camera(scene);
}

void OgrePeer::open_window() {
    log_.createLog("", true, false, true);
    root_ = std::make_unique<Ogre::Root>("", "", "");
    root_->loadPlugin(GNOMON_OGRE_PLUGINS "/RenderSystem_GL");
    root_->setRenderSystem(root_->getAvailableRenderers().front());
    root_->initialise(false);
    const Ogre::NameValuePairList options{{"vsync", "false"}, {"FSAA", "0"}};
    window_ =
        root_->createRenderWindow("gnomon-peer-ogre", size_.width, size_.height, false, &options);
    // The vertex programs that extrude.
    Ogre::ResourceGroupManager::getSingleton().addResourceLocation(
        GNOMON_OGRE_MEDIA "/ShadowVolume", "FileSystem", Ogre::RGN_INTERNAL);
    Ogre::ResourceGroupManager::getSingleton().initialiseAllResourceGroups();
}

void OgrePeer::add_materials() {
    const auto add = [](const char* name, float gray) {
        auto material = Ogre::MaterialManager::getSingleton().create(name, Ogre::RGN_DEFAULT);
        material->setAmbient(gray, gray, gray);
        material->setDiffuse(gray, gray, gray, 1.0F);
        material->setSpecular(0.0F, 0.0F, 0.0F, 1.0F);
    };
    add("caster", 0.75F);
    add("ground", 0.55F);
}

void OgrePeer::add_lights(const PeerScene& scene) {
    for (const Light& light : scene.lights) {
        Ogre::Light* made = scene_manager_->createLight();
        const bool is_sun = light.position_world.w == 0.0;
        made->setType(is_sun ? Ogre::Light::LT_DIRECTIONAL : Ogre::Light::LT_POINT);
        made->setDiffuseColour(1.0F, 1.0F, 1.0F);
        made->setSpecularColour(0.0F, 0.0F, 0.0F);
        if (!is_sun)
            made->setAttenuation(beyond_all, 0.0F, 0.0F, static_cast<float>(1.0 / light.intensity));
        lights_.push_back(scene_manager_->getRootSceneNode()->createChildSceneNode());
        lights_.back()->attachObject(made);
        move_light(lights_.size() - 1, light.position_world);
    }
}

void OgrePeer::add_camera(const PeerScene& scene) {
    Ogre::Camera* camera = scene_manager_->createCamera("camera");
    camera->setNearClipDistance(static_cast<float>(scene.near_m));
    camera->setFarClipDistance(0.0F);  // none
    camera->setFOVy(Ogre::Radian(static_cast<float>(scene.fovy_rad)));
    camera->setAspectRatio(static_cast<float>(size_.width) / static_cast<float>(size_.height));
    Ogre::SceneNode* node = scene_manager_->getRootSceneNode()->createChildSceneNode();
    node->attachObject(camera);
    node->setFixedYawAxis(true);
    node->setPosition(to_ogre(scene.eye));
    node->lookAt(to_ogre(scene.target), Ogre::Node::TS_WORLD);
    window_->addViewport(camera)->setBackgroundColour(Ogre::ColourValue(0.05F, 0.06F, 0.08F));
}

void OgrePeer::move_instance(std::size_t instance, const glm::dmat4& world_from_local) {
    nodes_[instance]->setPosition(to_ogre(world_from_local[3]));
    nodes_[instance]->setOrientation(rotation_of(world_from_local));
}

void OgrePeer::move_light(std::size_t light, const glm::dvec4& position_world) {
    if (position_world.w == 0.0) {
        lights_[light]->setDirection(-to_ogre(position_world), Ogre::Node::TS_WORLD);
    } else {
        lights_[light]->setPosition(to_ogre(position_world));
    }
}

Status OgrePeer::draw(bool shadows, bool dry) {
    const auto wanted = shadows ? Ogre::SHADOWTYPE_STENCIL_ADDITIVE : Ogre::SHADOWTYPE_NONE;
    if (scene_manager_->getShadowTechnique() != wanted) scene_manager_->setShadowTechnique(wanted);
    const std::uint64_t before = draws_seen();
    set_dry(dry);
    root_->renderOneFrame();
    set_dry(false);
    if (draws_seen() == before)
        return fail(ErrorCode::Internal, "OGRE drew nothing through the switch.");
    if (!dry) finish();
    return {};
}

}  // namespace

}  // namespace gnomon::peers

int main(int argc, char** argv) {
    using namespace gnomon::peers;
    return run_peer(argc, argv,
                    [](const PeerScene& scene, Size size) -> gnomon::Result<std::unique_ptr<Peer>> {
                        return std::make_unique<OgrePeer>(scene, size);
                    });
}
