// SPDX-License-Identifier: MIT
#include "internal/gltf_nodes.hpp"

#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include <gnomon/scene/deform.hpp>
#include <gnomon/scene/transforms.hpp>

#include "internal/gltf_material.hpp"
#include "internal/gltf_mesh.hpp"
#include "internal/gltf_skin.hpp"
#include "internal/json_place.hpp"

namespace gnomon::scene::internal {
namespace {

constexpr std::size_t most_entities = 4'000'000;
/// Each instance that deforms has vertices of its own, and a small file may have any number of
/// them.
constexpr std::size_t most_deformed_numbers = std::size_t{1} << 25U;

glm::dvec3 vec3_or(const std::vector<double>& values, double otherwise) {
    return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : glm::dvec3(otherwise);
}

glm::dquat quaternion(double x, double y, double z, double w) {
    return glm::normalize(glm::dquat(w, x, y, z));
}

LocalTransform local_of(const tinygltf::Node& node) {
    LocalTransform local;
    if (node.matrix.size() == 16) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) {
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        }
        for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1.0 : 0.0;
        local.matrix = matrix;
        return local;
    }
    local.translation = vec3_or(node.translation, 0.0);
    local.scale = vec3_or(node.scale, 1.0);
    if (node.rotation.size() == 4) {
        local.rotation =
            quaternion(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]);
    }
    return local;
}

class SceneBuilder : AnimationTargets {
public:
    SceneBuilder(const GltfModel& model, const GltfOptions& options)
        : model_(model),
          meshes_(model, scene_.messages),
          entities_(model.model.nodes.size()),
          mesh_entities_(model.model.nodes.size()) {
        scene_.materials = read_materials(model, scene_.messages);
        for (const auto& node : model.model.nodes) {
            if (node.mesh >= 0 && node.skin >= 0) skinned_meshes_.insert(node.mesh);
        }
        for (const int root : roots(options)) add_tree(root);
        update_world_transforms(scene_.registry);
        for (const int node : skinned_nodes_) add_skinned(node);
        check_transforms();
        scene_.animations = read_animations(model, *this);
        if (const Status deformed = deform(scene_); !deformed) {
            std::string what = deformed.error().message;
            if (what.ends_with('.')) what.pop_back();
            refuse_input(model.file, what);
        }
        add_messages();
    }

    Scene take() { return std::move(scene_); }

private:
    void message(const std::string& what) {
        scene_.messages.push_back(fmt::format("{}: {}.", model_.file, what));
    }

    std::vector<int> roots(const GltfOptions& options) {
        const auto& scenes = model_.model.scenes;
        const auto count = static_cast<int>(scenes.size());
        if (options.scene >= count) {
            refuse_input(model_.file, fmt::format("scene {} was asked for, but the file has {}",
                                                  options.scene, count));
        }
        int chosen = options.scene >= 0 ? options.scene : model_.model.defaultScene;
        if (chosen < 0) chosen = 0;
        if (count > 0) return scenes[static_cast<std::size_t>(chosen)].nodes;

        message("the file has no scene; all its nodes are taken");
        std::vector<bool> is_child(model_.model.nodes.size(), false);
        for (const auto& node : model_.model.nodes) {
            for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = true;
        }
        std::vector<int> all;
        for (std::size_t i = 0; i < is_child.size(); ++i) {
            if (!is_child[i]) all.push_back(static_cast<int>(i));
        }
        return all;
    }

    /// Depth first without recursion: files may nest as deep as they like.
    void add_tree(int root) {
        struct Pending {
            int node;
            std::optional<Entity> parent;
        };
        std::vector<Pending> pending{{root, std::nullopt}};
        while (!pending.empty()) {
            const Pending next = pending.back();
            pending.pop_back();
            auto& entity = entities_[static_cast<std::size_t>(next.node)];
            if (entity) {
                message(fmt::format("nodes[{}] is listed twice in the scene; it is taken once",
                                    next.node));
                continue;
            }
            entity = add_node(next.node, next.parent);
            const auto& children = source(next.node).children;
            for (auto child = children.rbegin(); child != children.rend(); ++child) {
                pending.push_back({*child, *entity});
            }
        }
    }

    [[nodiscard]] const tinygltf::Node& source(int node) const {
        return model_.model.nodes[static_cast<std::size_t>(node)];
    }

    [[nodiscard]] std::string name_of(int index) const {
        const tinygltf::Node& node = source(index);
        if (!node.name.empty()) return node.name;
        if (node.mesh >= 0) {
            const auto& mesh = model_.model.meshes[static_cast<std::size_t>(node.mesh)];
            if (!mesh.name.empty()) return mesh.name;
        }
        return fmt::format("node {}", index);
    }

    Entity create(std::string name, const LocalTransform& local, std::optional<Entity> parent) {
        if (scene_.registry.size() >= most_entities) {
            refuse_input(model_.file, fmt::format("the scene has more than {} nodes and instances",
                                                  most_entities));
        }
        return scene_.create_node(std::move(name), local, parent);
    }

    [[nodiscard]] std::vector<Entity> of(std::size_t node, AnimationPath path) const override {
        if (path == AnimationPath::Weights) return mesh_entities_[node];
        if (!entities_[node]) return {};
        return {*entities_[node]};
    }

    void spend(std::size_t numbers, int node) {
        deformed_numbers_ += numbers;
        if (deformed_numbers_ > most_deformed_numbers) {
            refuse_input(model_.file,
                         fmt::format("nodes[{}] brings the vertices of deforming instances and the "
                                     "numbers of their joints to {}, but at most {} are kept",
                                     node, deformed_numbers_, most_deformed_numbers));
        }
    }

    void add_mesh_instance(int node, Entity entity, std::shared_ptr<const Mesh> mesh) {
        mesh_entities_[static_cast<std::size_t>(node)].push_back(entity);
        if (mesh->deformation) spend(mesh->positions.size(), node);
        if (mesh->deformation && !mesh->deformation->targets.empty()) {
            const std::vector<double>& weights = source(node).weights;
            scene_.registry.emplace<MorphWeights>(
                entity, weights.empty() ? mesh->deformation->default_weights : weights);
        }
        scene_.registry.emplace<MeshInstance>(entity, std::move(mesh));
        scene_.registry.emplace<Caster>(entity);
        scene_.registry.emplace<Receiver>(entity);
    }

    Entity add_node(int index, std::optional<Entity> parent) {
        const tinygltf::Node& node = source(index);
        const Entity entity = create(name_of(index), local_of(node), parent);
        if (node.camera >= 0) add_camera(entity, node.camera);
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light != node.extensions.end()) {
            add_light(entity, light->second.Get("light").GetNumberAsInt());
        }
        if (node.mesh < 0) return entity;

        const bool is_skinned_mesh = skinned_meshes_.count(node.mesh) != 0;
        const std::shared_ptr<const Mesh>& mesh = meshes_.read(node.mesh, is_skinned_mesh);
        if (!mesh) return entity;
        if (node.skin >= 0 && mesh->deformation && mesh->deformation->is_skinned()) {
            skinned_nodes_.push_back(index);
        } else if (const auto instancing = node.extensions.find("EXT_mesh_gpu_instancing");
                   instancing != node.extensions.end()) {
            add_instances(entity, index, instancing->second.Get("attributes"), mesh);
        } else {
            add_mesh_instance(index, entity, mesh);
        }
        return entity;
    }

    void add_instances(Entity parent, int node, const tinygltf::Value& attributes,
                       const std::shared_ptr<const Mesh>& mesh) {
        const auto view_of = [&](const char* name) -> std::optional<AccessorView> {
            if (!attributes.Has(name)) return std::nullopt;
            return AccessorView(model_, attributes.Get(name).GetNumberAsInt());
        };
        const auto translation = view_of("TRANSLATION");
        const auto rotation = view_of("ROTATION");
        const auto scale = view_of("SCALE");
        const std::size_t count = translation ? translation->count()
                                  : rotation  ? rotation->count()
                                              : scale->count();
        const std::string name = name_of(node);
        for (std::size_t i = 0; i < count; ++i) {
            LocalTransform local;
            if (translation) {
                local.translation = {translation->get(i, 0), translation->get(i, 1),
                                     translation->get(i, 2)};
            }
            if (rotation) {
                local.rotation = quaternion(rotation->get(i, 0), rotation->get(i, 1),
                                            rotation->get(i, 2), rotation->get(i, 3));
            }
            if (scale) local.scale = {scale->get(i, 0), scale->get(i, 1), scale->get(i, 2)};
            const Entity entity = create(fmt::format("{} instance {}", name, i), local, parent);
            add_mesh_instance(node, entity, mesh);
        }
    }

    void add_camera(Entity entity, int index) {
        const auto& source = model_.model.cameras[static_cast<std::size_t>(index)];
        Camera camera;
        if (source.type == "orthographic") {
            camera.projection = OrthographicCamera{
                std::abs(source.orthographic.xmag), std::abs(source.orthographic.ymag),
                source.orthographic.znear, source.orthographic.zfar};
        } else {
            camera.projection =
                PerspectiveCamera{source.perspective.yfov, source.perspective.znear};
        }
        scene_.registry.emplace<Camera>(entity, camera);
    }

    void add_light(Entity entity, int index) {
        const auto& source = model_.model.lights[static_cast<std::size_t>(index)];
        const glm::vec3 color(vec3_or(source.color, 1.0));
        const auto intensity = static_cast<float>(source.intensity);
        std::optional<double> range_m;
        if (source.range > 0.0) range_m = source.range;
        if (source.type == "point") {
            scene_.registry.emplace<PointLight>(entity, color, intensity, range_m);
        } else if (source.type == "spot") {
            scene_.registry.emplace<SpotLight>(entity, color, intensity, range_m,
                                               static_cast<float>(source.spot.innerConeAngle),
                                               static_cast<float>(source.spot.outerConeAngle));
        } else {
            scene_.registry.emplace<DirectionalLight>(entity, color, intensity);
        }
    }

    /// An entity of its own: the transform of a skinned mesh's node does not count, joints alone
    /// place its vertices.
    void add_skinned(int index) {
        const tinygltf::Node& node = source(index);
        const tinygltf::Skin& source = model_.model.skins[static_cast<std::size_t>(node.skin)];
        Skin skin;
        for (std::size_t i = 0; i < source.joints.size(); ++i) {
            const auto& joint = entities_[static_cast<std::size_t>(source.joints[i])];
            if (!joint) {
                refuse_input(model_.file, fmt::format("skins[{}].joints[{}] is node {}, but that "
                                                      "is not in the scene that nodes[{}] is in",
                                                      node.skin, i, source.joints[i], index));
            }
            skin.joints.push_back(*joint);
        }
        auto& matrices = inverse_bind_matrices_[node.skin];
        if (!matrices) {
            matrices = std::make_shared<const std::vector<glm::dmat4>>(
                inverse_bind_matrices(model_, source));
        }
        skin.inverse_bind_matrices = matrices;
        const Entity entity = create(name_of(index), {}, std::nullopt);
        spend(16 * skin.joints.size(), index);
        scene_.registry.emplace<Skin>(entity, std::move(skin));
        add_mesh_instance(index, entity, meshes_.read(node.mesh, true));
    }

    /// Finite numbers in a file can still multiply to infinity along a chain of nodes.
    void check_transforms() {
        scene_.registry.each<WorldTransform, Name>([this](Entity, const WorldTransform& world,
                                                          const Name& name) {
            double sum = 0.0;
            for (int column = 0; column < 4; ++column) {
                const glm::dvec4& c = world.world_from_local[column];
                sum += std::abs(c.x) + std::abs(c.y) + std::abs(c.z) + std::abs(c.w);
            }
            if (!std::isfinite(sum)) {
                refuse_input(model_.file,
                             fmt::format("the transform of node \"{}\" is not finite", name.value));
            }
        });
    }

    void add_messages() {
        for (std::size_t i = 0; i < model_.animations.size(); ++i) {
            const std::size_t left_out = model_.animations[i].left_out;
            if (left_out == 0) continue;
            message(
                fmt::format("animations[{}] has {} channels that are left out: they have no "
                            "node, a path that only an extension knows, or a node with a "
                            "matrix",
                            i, left_out));
        }
        if (scene_.registry.count<MeshInstance>() == 0) message("the scene has no triangles");
    }

    const GltfModel& model_;
    Scene scene_;
    MeshReader meshes_;
    std::vector<std::optional<Entity>> entities_;     // by node
    std::vector<std::vector<Entity>> mesh_entities_;  // by node: what carries its mesh
    std::set<int> skinned_meshes_;
    std::vector<int> skinned_nodes_;
    std::size_t deformed_numbers_ = 0;
    std::map<int, std::shared_ptr<const std::vector<glm::dmat4>>> inverse_bind_matrices_;
};

}  // namespace

Scene build_scene(const GltfModel& model, const GltfOptions& options) {
    return SceneBuilder(model, options).take();
}

}  // namespace gnomon::scene::internal
