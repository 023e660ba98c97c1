// Chooses the frame that reads a normal map without the tangents of its file, primitive by primitive, by measurement:
//
//     auto scene = cotan::loadScene("model.glb");
//     if (!scene)
//         return fail(scene.error().message);
//     for (const cotan::FrameDecision& d : cotan::chooseFrames(*scene))
//         std::printf("%s: %s\n", scene->meshes[d.mesh].name.c_str(), cotan::textOf(d).c_str());
//
// What a map means on a primitive is fixed: the frame that the file names for it; otherwise what the file's tangents
// show; otherwise MikkTSpace over its uv, as glTF says. Candidates are compared with that meaning at points that are
// spread evenly over the surface, by the angle between the perturbed normals, with the texels of the map. The first one
// within the limits is taken, in the order of cost: `orthonormal`, which stores and makes nothing; `triangle`; `smooth`
// and `mikktspace`, whose vectors are made when the model is loaded. If none is, the tangents of the file stay.
// Mirrored parts, seams and reversed or missing signs of tangents need no rules of their own: they are errors of the
// candidates. Part of the library cotan::bake.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "cotan/frame.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// Degrees of the perturbed normal, weighted by area, that a candidate may be off.
struct ChoiceLimits {
    double mean = 0.3, percentile99 = 3;

    // Limits for one number, as options state it: of the mean, and ten times as much on 99 % of the area.
    static ChoiceLimits of(double degrees) { return {degrees, 10 * degrees}; }
};

// One way to read the map.
struct FrameCandidate {
    Frame frame = Frame::orthonormal;
    TangentOrigin tangents = TangentOrigin::generated; // stored: the tangents of the file stay
    std::size_t points = 0;                            // that were compared; 0: not judged, and the rest is NaN
    double mean = std::numeric_limits<double>::quiet_NaN();
    double percentile95 = mean, percentile99 = mean, maximum = mean; // smallest value that 95 or 99 % do not exceed

    bool within(const ChoiceLimits& limits) const { return mean <= limits.mean && percentile99 <= limits.percentile99; }
};

enum class MapMeaning { named, stored, mikktspace };

enum class ChoiceReason {
    noMap,     // nothing reads a frame
    named,     // the file names the frame
    fits,      // the first candidate within the limits
    keeps,     // no candidate is: the tangents of the file stay
    notJudged, // there is nothing to compare: what is there stays
};

struct FrameDecision {
    std::size_t mesh = 0; // index into Scene::meshes
    MapMeaning meaning = MapMeaning::mikktspace;
    ChoiceReason reason = ChoiceReason::noMap;
    Frame frame = Frame::orthonormal;                  // that was chosen
    TangentOrigin tangents = TangentOrigin::generated; // stored: the tangents of the file stay
    std::vector<FrameCandidate> candidates{};          // in the order of cost, up to the chosen one, or all
    std::string notJudged{};                           // why: "no uv"; empty if the map was judged, or there is none

    // Whether the tangents of the file, if it has any, are not needed any more.
    bool dropsTangents() const { return tangents == TangentOrigin::generated; }
    // The candidate that was chosen; null if none was measured.
    const FrameCandidate* chosen() const;
};

struct ChoiceOptions {
    ChoiceLimits limits{};
    bool all = false;                               // measure all candidates, not only those up to the chosen one
    TangentOrigin tangents = TangentOrigin::stored; // generated: those of the file count for nothing and never stay
};

// One decision for each mesh of the scene, in order. Deterministic. Takes about 2 ms for a primitive of which the first
// candidate fits, and the time to generate tangents for one without; of primitives with over 200,000 triangles parts
// are judged. A mesh whose instances stretch it differently is judged by the worst of the first eight. A clear coat
// with the uv of the surface's map counts like it. Meshes without pixels of their map, without uv, or without triangles
// that have area in space and uv are not judged. For an inconsistent scene (checkScene) the result is empty.
std::vector<FrameDecision> chooseFrames(const Scene& scene, const ChoiceOptions& options = {});

// One line: "orthonormal: 0.12 degrees on average, 1.3 on 1 % of the area", and where tangents stay, why and what the
// candidates would cost.
std::string textOf(const FrameDecision& decision);

} // namespace cotan
