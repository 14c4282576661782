// SPDX-License-Identifier: MIT
//
// gnomon-peer-irrlicht: the shared scenes by Irrlicht 1.8, its OpenGL driver and its stencil
// shadows with their defaults: depth-fail, volumes of finite length built on the processor. All
// lights' volumes are counted into one stencil, and what is not zero is darkened once.
#include <algorithm>

#include <irrlicht/irrlicht.h>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "gl_switch.hpp"
#include "peer.hpp"

namespace gnomon::peers {

namespace {

namespace core = irr::core;
namespace video = irr::video;
using irr::f32;

// Faces and vertices of a shadow mesh are numbered in sixteen bits.
constexpr std::size_t sixteen_bits = 65'536;
constexpr float sun_distance = 2'000.0F;
constexpr float beyond_all = 1e5F;
// Behind the far end of every volume: Irrlicht leaves out those that reach through the far plane.
constexpr float far_m = 20'000.0F;

// Irrlicht is left-handed, with clockwise fronts: everything is mirrored in Z.
core::vector3df to_irrlicht(const glm::dvec3& v) {
    const glm::vec3 f(v);
    return {f.x, f.y, -f.z};
}

core::vector3df degrees_of(const glm::dmat4& pose) {
    glm::dmat4 mirror(1.0);
    mirror[2][2] = -1.0;
    const glm::mat4 mirrored(mirror * pose * mirror);
    core::matrix4 matrix;
    matrix.setM(glm::value_ptr(mirrored));
    return matrix.getRotationDegrees();
}

struct Drop {
    void operator()(irr::IReferenceCounted* object) const { object->drop(); }
};
template <class T>
using Counted = std::unique_ptr<T, Drop>;

Counted<irr::scene::SMesh> make_mesh(const PeerMesh& source, int gray) {
    Counted<irr::scene::SMeshBuffer> buffer(new irr::scene::SMeshBuffer);
    const auto shade = static_cast<irr::u32>(gray);
    for (std::size_t i = 0; i < source.positions.size(); ++i) {
        buffer->Vertices.push_back(video::S3DVertex(to_irrlicht(source.positions[i]),
                                                    to_irrlicht(source.normals[i]),
                                                    {255, shade, shade, shade}, {0.0F, 0.0F}));
    }
    for (std::size_t i = 0; i + 2 < source.indices.size(); i += 3) {
        for (const std::size_t corner : {i, i + 2, i + 1})
            buffer->Indices.push_back(static_cast<irr::u16>(source.indices[corner]));
    }
    buffer->Material.Lighting = true;
    buffer->Material.ColorMaterial = video::ECM_DIFFUSE_AND_AMBIENT;
    buffer->recalculateBoundingBox();
    buffer->setHardwareMappingHint(irr::scene::EHM_STATIC);
    Counted<irr::scene::SMesh> mesh(new irr::scene::SMesh);
    mesh->addMeshBuffer(buffer.get());
    mesh->recalculateBoundingBox();
    return mesh;
}

// The scene, once with shadows and once without.
struct Stage {
    irr::scene::ISceneManager* manager = nullptr;
    std::vector<irr::scene::IMeshSceneNode*> nodes;
    std::vector<irr::scene::ILightSceneNode*> lights;
};

class IrrlichtPeer final : public Peer {
public:
    IrrlichtPeer(const PeerScene& scene, Size size, Counted<irr::IrrlichtDevice> device);

    void move_instance(std::size_t instance, const glm::dmat4& world_from_local) override;
    void move_light(std::size_t light, const glm::dvec4& position_world) override;
    Status draw(bool shadows, bool dry) override;
    Result<std::vector<std::byte>> picture() override {
        return read_back_buffer(size_.width, size_.height);
    }
    nlohmann::ordered_json describe() const override {
        return {{"engine", "Irrlicht " IRRLICHT_SDK_VERSION " (stencil shadows)"},
                {"device", device_name()}};
    }

private:
    void fill(Stage& stage, const PeerScene& scene, bool shadows);

    Size size_;
    Counted<irr::IrrlichtDevice> device_;
    std::vector<Counted<irr::scene::SMesh>> meshes_;
    Counted<irr::scene::ISceneManager> second_;
    Stage with_;
    Stage without_;
};

IrrlichtPeer::IrrlichtPeer(const PeerScene& scene, Size size, Counted<irr::IrrlichtDevice> device)
    : size_(size), device_(std::move(device)) {
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        meshes_.push_back(make_mesh(scene.meshes[i], scene.casts(i) ? 191 : 140));
    }
    with_.manager = device_->getSceneManager();
    second_.reset(with_.manager->createNewSceneManager(false));
    without_.manager = second_.get();
    fill(with_, scene, true);
    fill(without_, scene, false);
}

void IrrlichtPeer::fill(Stage& stage, const PeerScene& scene, bool shadows) {
    stage.manager->setAmbientLight({0.15F, 0.15F, 0.15F, 1.0F});
    stage.manager->setShadowColor({150, 0, 0, 0});
    for (const Instance& instance : scene.instances) {
        auto* node = stage.manager->addMeshSceneNode(meshes_[instance.mesh].get());
        if (shadows && instance.casts) {
            node->addShadowVolumeSceneNode();
            // Or what is out of sight casts no shadow.
            node->setAutomaticCulling(irr::scene::EAC_OFF);
        }
        stage.nodes.push_back(node);
    }
    for (const Light& light : scene.lights) {
        auto* node = stage.manager->addLightSceneNode(nullptr, {}, {1.0F, 1.0F, 1.0F}, beyond_all);
        video::SLight& data = node->getLightData();
        data.Type = light.position_world.w == 0.0 ? video::ELT_DIRECTIONAL : video::ELT_POINT;
        data.SpecularColor = {0.0F, 0.0F, 0.0F};
        data.Attenuation = {0.0F, 0.0F, static_cast<f32>(1.0 / light.intensity)};
        if (light.position_world.w == 0.0) data.Attenuation = {1.0F, 0.0F, 0.0F};
        node->setLightType(data.Type);
        stage.lights.push_back(node);
    }
    auto* camera = stage.manager->addCameraSceneNode(nullptr, to_irrlicht(scene.eye),
                                                     to_irrlicht(scene.target));
    camera->setFOV(static_cast<f32>(scene.fovy_rad));
    camera->setAspectRatio(static_cast<f32>(size_.width) / static_cast<f32>(size_.height));
    camera->setNearValue(static_cast<f32>(scene.near_m));
    camera->setFarValue(far_m);
}

void IrrlichtPeer::move_instance(std::size_t instance, const glm::dmat4& world_from_local) {
    for (const Stage* stage : {&with_, &without_}) {
        stage->nodes[instance]->setPosition(to_irrlicht(world_from_local[3]));
        stage->nodes[instance]->setRotation(degrees_of(world_from_local));
    }
}

void IrrlichtPeer::move_light(std::size_t light, const glm::dvec4& position_world) {
    const core::vector3df place = to_irrlicht(position_world);
    for (const Stage* stage : {&with_, &without_}) {
        if (position_world.w == 0.0) {
            // Lighting takes the rotation; shadows take the place, having no other idea of a sun.
            stage->lights[light]->setRotation((-place).getHorizontalAngle());
            stage->lights[light]->getLightData().Position = place * sun_distance;
        } else {
            stage->lights[light]->setPosition(place);
        }
    }
}

Status IrrlichtPeer::draw(bool shadows, bool dry) {
    video::IVideoDriver* driver = device_->getVideoDriver();
    const std::uint64_t before = draws_seen();
    set_dry(dry);
    device_->run();
    driver->beginScene(true, true, {255, 13, 15, 20});
    (shadows ? with_ : without_).manager->drawAll();
    driver->endScene();
    set_dry(false);
    if (draws_seen() == before)
        return fail(ErrorCode::Internal, "Irrlicht drew nothing through the switch.");
    if (!dry) finish();
    return {};
}

Result<std::unique_ptr<Peer>> make(const PeerScene& scene, Size size) {
    for (const Instance& instance : scene.instances) {
        const PeerMesh& mesh = scene.meshes[instance.mesh];
        const std::size_t largest = std::max(mesh.triangle_count(), mesh.positions.size());
        if (largest <= sixteen_bits) continue;
        return fail(ErrorCode::Unsupported,
                    fmt::format("Irrlicht numbers the faces and vertices of a shadow mesh in "
                                "sixteen bits, up to {}; the scene has a mesh with {}.",
                                sixteen_bits, largest));
    }
    irr::SIrrlichtCreationParameters parameters;
    parameters.DriverType = video::EDT_OPENGL;
    parameters.WindowSize = {size.width, size.height};
    parameters.Bits = 32;
    parameters.ZBufferBits = 24;
    parameters.Stencilbuffer = true;
    parameters.Vsync = false;
    Counted<irr::IrrlichtDevice> device(irr::createDeviceEx(parameters));
    if (!device) {
        return fail(ErrorCode::Unsupported,
                    "Irrlicht could not open an OpenGL window; is there a display?");
    }
    return std::make_unique<IrrlichtPeer>(scene, size, std::move(device));
}

}  // namespace

}  // namespace gnomon::peers

int main(int argc, char** argv) { return gnomon::peers::run_peer(argc, argv, gnomon::peers::make); }
