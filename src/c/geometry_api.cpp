// cotan.h: frames and tangents.
#include "cotan/frame.hpp"
#include "meshes.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

glm::vec3 vec3At(const float* array, std::size_t i) { return {array[3 * i], array[3 * i + 1], array[3 * i + 2]}; }

void store(float* array, std::size_t i, const glm::vec3& v)
{
    array[3 * i] = v.x, array[3 * i + 1] = v.y, array[3 * i + 2] = v.z;
}

// Calls work(i, frame) for every surface point.
void forEachPoint(const char* frame, const cotan_surface_points* given, const auto& work)
{
    const auto kind = frameFromName(word(frame, "frame"));
    if (!kind || readsVertices(*kind))
        fail(ErrorKind::usage, "frame: expected one made from differences, found '", frame, "'");
    const cotan_surface_points& p = checked(given, "points");
    require(p.count == 0 || (p.normals && p.dpdx && p.dpdy && p.duvdx && p.duvdy),
            "points: expected five arrays, found null");
    const auto uv = [](const float* array, std::size_t i) { return glm::vec2(array[2 * i], array[2 * i + 1]); };
    for (std::size_t i = 0; i < p.count; ++i)
        work(i,
             evaluate(*kind, vec3At(p.normals, i), vec3At(p.dpdx, i), vec3At(p.dpdy, i), uv(p.duvdx, i),
                      uv(p.duvdy, i)));
}

void forEachPoint(const char* frame, const cotan_interpolated_points* given, const auto& work)
{
    const cotan_interpolated_points& p = checked(given, "points");
    const auto kind = frameFromName(word(frame, "frame"));
    if (!kind || !readsVertices(*kind))
        fail(ErrorKind::usage, "frame: expected one made at the vertices, found '", frame, "'");
    const bool smooth = readsCotangents(*kind);
    require(p.count == 0 || (p.normals && (smooth ? p.cotangents_u && p.cotangents_v : p.tangents != nullptr)),
            smooth ? "points: expected normals and two arrays of cotangents, found null"
                   : "points: expected normals and tangents, found null");
    for (std::size_t i = 0; i < p.count; ++i) {
        const glm::vec3 n = vec3At(p.normals, i);
        if (smooth) {
            work(i, evaluateCotangents(*kind, n, vec3At(p.cotangents_u, i), vec3At(p.cotangents_v, i)));
            continue;
        }
        const float* t = p.tangents + 4 * i;
        const glm::vec4 tangent = tangentAlongV({t[0], t[1], t[2], t[3]});
        work(i, evaluateTangents(*kind, n, glm::vec3(tangent), tangent.w));
    }
}

// Maps texels to normals, or normals to texels, by the frames.
void mapByFrames(const char* frame, const auto* points, const float* from, float* to, const auto& map)
{
    require(from && to, "texels and normals: expected arrays, found null");
    forEachPoint(frame, points,
                 [&](std::size_t i, const f32::cotan_frame& f) { store(to, i, map(f, vec3At(from, i))); });
}

// Checks the arguments and returns the kind of tangents. The words are not looked up in the table of frames, so that
// the npm package cotan/tangents need not contain the table.
Frame checkedTangents(const char* kind, int threads, const float* tangents)
{
    const std::string_view which = word(kind, "kind");
    const bool byArea = which == "area-weighted";
    if (which != "vertex" && which != "mikktspace" && !byArea)
        fail(ErrorKind::usage, "kind: expected mikktspace, area-weighted or vertex, found '", which, "'");
    require(threads >= 0, "threads: expected 0 or more");
    require(tangents, "tangents: expected an array, found null");
    return byArea ? Frame::areaWeighted : which == "vertex" ? Frame::vertex : Frame::mikktspace;
}

void storeCotangents(const Cotangents& made, float* u, float* v)
{
    put(made.u, u, "u");
    put(made.v, v, "v");
}

// Reports only the begin and the end.
Result<std::vector<glm::vec4>> vertexTangentsWithProgress(const MeshView& mesh, const Progress& progress)
{
    if (progress && !progress(0))
        return stoppedError();
    std::vector<glm::vec4> made = vertexTangents(mesh);
    if (progress && !progress(1))
        return stoppedError();
    return made;
}

} // namespace

int cotan_frame_count(void) { return kFrameCount; }

const char* cotan_frame_name(int frame)
{
    return isFrame(frame) ? name(Frame(frame)).data() : nullptr; // a literal, which ends with a zero
}

cotan_status cotan_frame_apply(const char* frame, const cotan_surface_points* points, const float* texels,
                               float* normals, char* message, size_t message_size)
{
    return call(message, message_size, [&] { mapByFrames(frame, points, texels, normals, f32::cotan_apply); });
}

cotan_status cotan_frame_encode(const char* frame, const cotan_surface_points* points, const float* normals,
                                float* texels, char* message, size_t message_size)
{
    return call(message, message_size, [&] { mapByFrames(frame, points, normals, texels, f32::cotan_encode); });
}

cotan_status cotan_vertex_frame_apply(const char* frame, const cotan_interpolated_points* points, const float* texels,
                                      float* normals, char* message, size_t message_size)
{
    return call(message, message_size, [&] { mapByFrames(frame, points, texels, normals, f32::cotan_apply); });
}

cotan_status cotan_vertex_frame_encode(const char* frame, const cotan_interpolated_points* points, const float* normals,
                                       float* texels, char* message, size_t message_size)
{
    return call(message, message_size, [&] { mapByFrames(frame, points, normals, texels, f32::cotan_encode); });
}

cotan_status cotan_tangents(const char* kind, const cotan_mesh* mesh, int threads, float* tangents, char* message,
                            size_t message_size)
{
    return call(message, message_size, [&] {
        const Frame frame = checkedTangents(kind, threads, tangents);
        put(generateTangents(frame, viewOf(mesh), threads), tangents, "tangents");
    });
}

cotan_status cotan_tangents_with_progress(const char* kind, const cotan_mesh* mesh, int threads,
                                          cotan_progress progress, void* user, float* tangents, char* message,
                                          size_t message_size)
{
    return call(message, message_size, [&] {
        const Frame frame = checkedTangents(kind, threads, tangents);
        const MeshView view = viewOf(mesh);
        const Progress reported = progressOf(progress, user);
        put(valueOf(frame == Frame::vertex             ? vertexTangentsWithProgress(view, reported)
                        : frame == Frame::areaWeighted ? areaWeightedTangents(view, threads, reported)
                                                       : mikktspaceTangents(view, threads, reported)),
            tangents, "tangents");
    });
}

cotan_status cotan_smooth_cotangents(const cotan_mesh* mesh, float* u, float* v, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(u && v, "u and v: expected arrays, found null");
        storeCotangents(smoothCotangents(viewOf(mesh)), u, v);
    });
}

cotan_status cotan_smooth_cotangents_with_progress(const cotan_mesh* mesh, int threads, cotan_progress progress,
                                                   void* user, float* u, float* v, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(threads >= 0, "threads: expected 0 or more");
        require(u && v, "u and v: expected arrays, found null");
        storeCotangents(valueOf(smoothCotangents(viewOf(mesh), threads, progressOf(progress, user))), u, v);
    });
}
