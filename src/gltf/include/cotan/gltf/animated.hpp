// A glTF model that moves: read once, and then at one moment after another.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/files/limits.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

struct GltfAnimation {
    std::string name;   // empty where the file gives none
    double seconds = 0; // to the last of its keys; 0 where none can be read
};

// Keeps the bytes of the file, and gives scenes of it. One thread at a time.
class AnimatedGltf {
public:
    // limits: also of each scene; its pose is not used. Errors: as loadGltf.
    static Result<std::unique_ptr<AnimatedGltf>> open(const std::filesystem::path& file, const LoadLimits& limits);
    ~AnimatedGltf();

    // In the order of the file; empty where it has none.
    const std::vector<GltfAnimation>& animations() const;

    // As loadGltf with that pose. images: those of a scene that was made here before, which are copied; null: they are
    // decoded. Errors: as loadGltf; ErrorKind::usage where there is no such animation.
    Result<Scene> at(const Pose& pose, const std::vector<Image>* images = nullptr);

    // Points, in the world, that the animation of that name or number reaches: of moments a thirtieth of a second
    // apart, from its start to its end; at most 256 of them, and of large models as many as pose 8 million vertices,
    // but 9 at least. Up to 300,000 points they are all vertices; beyond, those of each moment that lie furthest along
    // 64 directions, so that the box around them may be too small by 2 % of the model. Kept for the next call. Errors:
    // as at().
    Result<std::vector<glm::vec3>> reach(const std::string& animation);

private:
    struct Work;
    explicit AnimatedGltf(std::unique_ptr<Work> work);
    std::unique_ptr<Work> work_;
};

} // namespace cotan
