// Converts glTF 2.0 and GLB files to a Scene.
#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "gltf/json/lookup.hpp"
#include "gltf_model.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"
#include "scene/parts.hpp"

namespace cotan {

namespace {

// Meshes that show the materials of variants: triangles in all, but at least so many each; and the number of those that
// differ from another one only by skin or morph weights.
constexpr std::size_t kMaxVariantTriangles = 1'000'000, kMinVariantTriangles = 64;
constexpr std::size_t kMaxVariantsAgain = 4096;

// A mesh of the file as used by a node: morph weights and skin make its primitives depend on the node.
struct MeshUse {
    int mesh = -1;
    int skin = -1;
    std::vector<double> weights;
    bool operator<(const MeshUse& other) const // libc++ 14 has no <=> of vectors
    {
        return std::tie(mesh, skin, weights) < std::tie(other.mesh, other.skin, other.weights);
    }
};

// Returns the first `count` matrices of a MAT4 float accessor, which may have more.
std::vector<glm::mat4> readMatrices(GltfModel& model, int accessor, std::size_t count, const std::string& field)
{
    const gltf::Elements& elements = model.accessors[std::size_t(accessor)];
    const gltf::Accessor& a = elements.accessor;
    if (a.type != gltf::ElementType::mat4 || a.componentType != gltf::kFloat)
        failGltf("{}: expected MAT4 of floats in accessors[{}], found {} of {}", field, accessor, gltf::nameOf(a.type),
                 gltf::nameOfComponent(a.componentType));
    if (a.count < count)
        failGltf("{}: expected {} matrices in accessors[{}], found {}", field, count, accessor, a.count);
    takeGltfBytes(model, std::uint64_t(count) * sizeof(glm::mat4), field);
    std::vector<glm::mat4> matrices(count, glm::mat4(0));
    if (count > 0)
        gltf::readNumbers(elements, count, 16, &matrices[0][0].x);
    return matrices;
}

class SceneBuilder {
public:
    SceneBuilder(GltfModel& model, Scene& scene)
        : model_(model), scene_(scene), materials_(model, scene), nodes_(readGltfNodes(model))
    {
    }

    void build(const std::vector<Image>* images)
    {
        std::size_t variants = 0;
        for (const gltf::Mesh& mesh : model_.structure.meshes)
            for (const gltf::Primitive& primitive : mesh.primitives)
                variants += primitive.others.size();
        trianglesOfVariant_ = std::max(kMaxVariantTriangles / std::max<std::size_t>(variants, 1), kMinVariantTriangles);
        readSkins();
        placeMeshes();
        checkUnusedMeshes();
        addGltfLightsAndCameras(model_, nodes_, scene_);
        if (images && images->size() == scene_.images.size()) {
            scene_.images = *images;
        } else {
            materials_.checkOtherImages();
            materials_.decodeImages();
        }
        if (scene_.instances.empty())
            model_.warnings.add("scene", "nothing to draw: no triangles");
    }

private:
    // Computes for each joint its world matrix times its inverse bind matrix.
    void readSkins()
    {
        for (std::size_t i = 0; i < model_.structure.skins.size(); ++i) {
            const gltf::Skin& skin = model_.structure.skins[i];
            const std::string field = fmt::format("skins[{}].inverseBindMatrices", i);
            std::vector<glm::mat4> bind(skin.joints.size(), glm::mat4(1));
            if (skin.inverseBindMatrices >= 0)
                bind = readMatrices(model_, skin.inverseBindMatrices, skin.joints.size(), field);
            std::vector<glm::dmat4>& joints = joints_.emplace_back();
            for (std::size_t j = 0; j < skin.joints.size(); ++j)
                joints.push_back(nodes_.world[std::size_t(skin.joints[j])] * glm::dmat4(bind[j]));
        }
    }

    Mesh finish(GltfPrimitive&& primitive)
    {
        const int material = primitive.mesh.material;
        const gltf::TextureUse map =
            material < 0 ? gltf::TextureUse{} : model_.structure.normalMaps[std::size_t(material)];
        Mesh mesh = finishGltfMesh(std::move(primitive), map.texture < 0 ? -1 : map.texcoord, model_.warnings);
        if (map.moves() && map.texcoord < 2 && !mesh.tangents.empty())
            transformTangents(mesh.tangents,
                              {mesh.positions, mesh.normals, mesh.texcoords[std::size_t(map.texcoord)], mesh.indices},
                              map.uRow, map.vRow);
        return mesh;
    }

    const gltf::Mesh& sourceMesh(int mesh) const { return model_.structure.meshes[std::size_t(mesh)]; }

    // What the scene has of a use.
    struct Made {
        std::vector<int> meshes;
        std::vector<int> variants;           // the same with the other materials of the primitives
        std::vector<glm::dmat3> stretches{}; // of instances of `variants`
    };

    int add(Mesh mesh, int use, std::size_t p)
    {
        mesh.material = materials_.use(mesh.material, mesh);
        mesh.source = {std::size_t(use), p};
        mesh.named = frameNamed(use, p);
        scene_.meshes.push_back(std::move(mesh));
        return int(scene_.meshes.size()) - 1;
    }

    // Whether the other materials of a mesh are shown by a new use of it; of very many skins or weights not by all.
    bool showsVariants(int mesh)
    {
        std::size_t count = 0;
        for (const gltf::Primitive& p : sourceMesh(mesh).primitives)
            count += p.others.size();
        const bool isFirst = withVariants_.insert(mesh).second;
        if (count == 0 || (!isFirst && repeatedVariants_ + count > kMaxVariantsAgain))
            return false;
        repeatedVariants_ += isFirst ? 0 : count;
        return true;
    }

    // The scene's meshes for a use, created on first use.
    Made& meshesFor(const MeshUse& use)
    {
        const auto [entry, isNew] = made_.emplace(use, Made());
        if (!isNew)
            return entry->second;
        const bool all = showsVariants(use.mesh);
        for (std::size_t p = 0; p < sourceMesh(use.mesh).primitives.size(); ++p) {
            auto primitive = readGltfPrimitive(model_, use.mesh, p, use.weights);
            if (!primitive)
                continue;
            if (use.skin >= 0)
                skinGltfPrimitive(*primitive, joints_[std::size_t(use.skin)], model_.warnings);
            std::vector<GltfPrimitive> others;
            for (const int material : all ? sourceMesh(use.mesh).primitives[p].others : std::vector<int>()) {
                others.push_back({primitive->field, partOfMesh(primitive->mesh, trianglesOfVariant_), {}, {}});
                others.back().mesh.material = material;
            }
            entry->second.meshes.push_back(add(finish(std::move(*primitive)), use.mesh, p));
            for (GltfPrimitive& other : others)
                entry->second.variants.push_back(add(finish(std::move(other)), use.mesh, p));
        }
        return entry->second;
    }

    std::optional<Frame> frameNamed(int mesh, std::size_t p)
    {
        return gltfFrame(sourceMesh(mesh).primitives[p].frame, primitiveField(std::size_t(mesh), p), model_.warnings);
    }

    MeshUse useOf(int node)
    {
        const gltf::Node& n = model_.structure.nodes[std::size_t(node)];
        MeshUse use{n.mesh, n.skin, n.weights.empty() ? sourceMesh(n.mesh).weights : n.weights};
        const auto hasJoints = [](const gltf::Primitive& p) { return p.attributes.contains("JOINTS_0"); };
        if (use.skin >= 0 && !std::ranges::all_of(sourceMesh(use.mesh).primitives, hasJoints)) {
            use.skin = -1;
            model_.warnings.add(fmt::format("nodes[{}]", node), "its mesh lacks JOINTS_0, so its skin is ignored");
        }
        return use;
    }

    // Skinned vertices are in world space already, so the transform of their node is not applied.
    void placeMeshes()
    {
        for (const int node : nodes_.visible) {
            const gltf::Node& source = model_.structure.nodes[std::size_t(node)];
            if (source.mesh < 0)
                continue;
            const MeshUse use = useOf(node);
            Made& made = meshesFor(use);
            const std::vector<int>& meshes = made.meshes;
            const std::vector<glm::mat4> placements =
                use.skin >= 0 ? std::vector<glm::mat4>{glm::mat4(1)} : gltfPlacements(model_, nodes_, node);
            const std::size_t instances = meshes.size() * placements.size();
            if (instances > instancesLeft_)
                failGltf("nodes[{}]: the limit is {} instances in total", node, model_.limits.nodes);
            instancesLeft_ -= instances;
            const auto show = [&](const std::vector<int>& shown, const glm::mat4& placement) {
                for (const int mesh : shown)
                    scene_.instances.push_back(
                        {source.name.empty() ? scene_.meshes[std::size_t(mesh)].name : source.name, mesh, placement});
            };
            for (const glm::mat4& placement : placements) {
                show(meshes, placement);
                const std::size_t known = made.stretches.size();
                if (!made.variants.empty() && known < kMaxStretches)
                    addDistinctLinearMap(made.stretches, glm::dmat3(glm::dmat4(placement)));
                if (made.stretches.size() > known)
                    show(made.variants, placement);
            }
        }
    }

    // Meshes that no node shows are read and discarded, so that damage in them is reported too.
    void checkUnusedMeshes()
    {
        std::vector<bool> used(model_.structure.meshes.size(), false);
        for (const auto& [use, meshes] : made_)
            used[std::size_t(use.mesh)] = true;
        for (std::size_t m = 0; m < used.size(); ++m)
            for (std::size_t p = 0; !used[m] && p < model_.structure.meshes[m].primitives.size(); ++p)
                if (auto primitive = readGltfPrimitive(model_, int(m), p, {}))
                    finish(std::move(*primitive));
    }

    GltfModel& model_;
    Scene& scene_;
    GltfMaterials materials_;
    GltfNodes nodes_;
    std::vector<std::vector<glm::dmat4>> joints_; // by skin
    std::map<MeshUse, Made> made_;
    std::set<int> withVariants_;                      // meshes of the file whose variants are shown
    std::size_t repeatedVariants_ = 0;                // meshes that show one again, by another skin or other weights
    std::size_t instancesLeft_ = model_.limits.nodes; // besides those of variants
    std::size_t trianglesOfVariant_ = kMaxVariantTriangles;
};

Scene load(const std::filesystem::path& path, const LoadLimits& limits)
{
    GltfModel model;
    readGltfModel(model, path, limits);
    // From here on only materials and image URIs are read from the JSON. They must not move, because URIs are string
    // views.
    for (auto& [collection, items] : model.file.json.get_ref<gltf::Json::object_t&>())
        if (collection != "materials" && collection != "images")
            items = nullptr;
    return buildGltfScene(model, path);
}

} // namespace

Scene buildGltfScene(GltfModel& model, const std::filesystem::path& path, const std::vector<Image>* images)
{
    Scene scene;
    scene.name = path.stem().string();
    SceneBuilder(model, scene).build(images);
    scene.warnings = model.warnings.lines();
    for (std::string& line : reconcileGreenWithTangents(scene))
        scene.warnings.push_back(std::move(line));
    return scene;
}

Result<Scene> loadGltf(const std::filesystem::path& file, const LoadLimits& limits)
{
    return caughtGltf(file, [&] { return load(file, limits); });
}

struct AnimatedGltf::Work {
    std::filesystem::path path;
    GltfModel model;
    // State after opening, restored before each pose.
    std::vector<gltf::Node> nodes;
    GltfWarnings warnings;
    std::uint64_t bytesTaken = 0;
    std::vector<GltfAnimation> animations;
    std::map<std::string, std::vector<glm::vec3>> reached;
};

AnimatedGltf::AnimatedGltf(std::unique_ptr<Work> work) : work_(std::move(work)) {}
AnimatedGltf::~AnimatedGltf() = default;

Result<std::unique_ptr<AnimatedGltf>> AnimatedGltf::open(const std::filesystem::path& file, const LoadLimits& limits)
{
    return caughtGltf(file, [&] {
        auto work = std::make_unique<Work>();
        work->path = file;
        LoadLimits atRest = limits;
        atRest.pose = {};
        readGltfModel(work->model, file, atRest);
        work->nodes = work->model.structure.nodes;
        work->animations = gltfAnimations(work->model);
        work->warnings = work->model.warnings;
        work->bytesTaken = work->model.bytesTaken;
        return std::unique_ptr<AnimatedGltf>(new AnimatedGltf(std::move(work)));
    });
}

const std::vector<GltfAnimation>& AnimatedGltf::animations() const { return work_->animations; }

Result<Scene> AnimatedGltf::at(const Pose& pose, const std::vector<Image>* images)
{
    return caughtGltf(work_->path, [&] {
        GltfModel& model = work_->model;
        model.structure.nodes = work_->nodes;
        model.warnings = work_->warnings;
        model.bytesTaken = work_->bytesTaken;
        model.verticesTaken = model.trianglesTaken = 0;
        model.limits.pose = pose;
        poseGltf(model);
        return buildGltfScene(model, work_->path, images);
    });
}

Result<std::vector<glm::vec3>> AnimatedGltf::reach(const std::string& animation)
{
    if (const auto known = work_->reached.find(animation); known != work_->reached.end())
        return known->second;
    const Pixels pixels = std::exchange(work_->model.limits.pixels, Pixels::none);
    Result<std::vector<glm::vec3>> points = pointsReached(*this, animation);
    work_->model.limits.pixels = pixels;
    if (points)
        work_->reached[animation] = *points;
    return points;
}

} // namespace cotan
