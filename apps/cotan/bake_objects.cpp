#include "bake_objects.hpp"

#include <unordered_set>
#include <utility>

#include "scene/geometry.hpp"

namespace cotan::app {

namespace {

// The meshes of these instances, in the order of their first use. Renumbers the instances accordingly.
std::vector<Mesh> meshesOf(std::vector<Instance>& instances, const std::vector<Mesh>& meshes)
{
    std::vector<int> number(meshes.size(), -1);
    std::vector<Mesh> kept;
    for (Instance& instance : instances) {
        int& n = number[std::size_t(instance.mesh)];
        if (n < 0) {
            n = int(kept.size());
            kept.push_back(meshes[std::size_t(instance.mesh)]);
        }
        instance.mesh = n;
    }
    return kept;
}

} // namespace

std::vector<std::string> objectNames(const Scene& scene)
{
    std::vector<std::string> names;
    std::unordered_set<std::string_view> known;
    for (const Instance& instance : scene.instances)
        if (const std::string& name = objectName(scene, instance); known.insert(name).second)
            names.push_back(name);
    return names;
}

SplitScene splitObject(Scene scene, std::string_view name)
{
    SplitScene split;
    std::vector<Instance> mine;
    for (Instance& instance : scene.instances)
        (objectName(scene, instance) == name ? mine : split.others.instances).push_back(instance);
    split.others.meshes = meshesOf(split.others.instances, scene.meshes);
    split.others.materials.resize(1);
    for (Mesh& mesh : split.others.meshes)
        mesh.material = 0;
    scene.meshes = meshesOf(mine, scene.meshes);
    scene.instances = std::move(mine);
    split.object = std::move(scene);
    return split;
}

} // namespace cotan::app
