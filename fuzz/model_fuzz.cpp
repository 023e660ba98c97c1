// OBJ, PLY and COLLADA through the checks in front of Assimp, and what passes them, with STL, FBX and 3DS, through Assimp
// in this process. Which format it is, is told from the first bytes.
#include <string_view>

#include "obj_check.hpp"
#include "scene_checks.hpp"

using namespace cotan;
using namespace cotan::fuzz;

namespace {

const char* nameOf(std::span<const std::uint8_t> bytes)
{
    if (startsWith(bytes, "ply"))
        return "model.ply";
    if (startsWith(bytes, "<"))
        return "model.dae";
    if (startsWith(bytes, "solid"))
        return "model.stl";
    if (startsWith(bytes, "MM"))
        return "model.3ds";
    if (startsWith(bytes, "; FBX") || startsWith(bytes, "Kaydara"))
        return "model.fbx";
    return "model.obj";
}

// What the check left of a text passes it again with the same facts.
void checkReducedObj(std::span<const std::uint8_t> bytes)
{
    std::string text(bytes.begin(), bytes.end());
    const auto first = checkObj(text, "model.obj", smallLimits());
    if (!first) {
        checkError(first.error());
        return;
    }
    std::string again = text;
    const auto second = checkObj(again, "model.obj", smallLimits());
    COTAN_HOLDS(bool(second), "{}", second ? "" : second.error().message);
    COTAN_HOLDS(again == text);
    COTAN_HOLDS(first->positions == second->positions && first->texcoords == second->texcoords
                && first->normals == second->normals && first->polygons == second->polygons
                && first->triangles == second->triangles && first->libraries == second->libraries);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Scratch scratch;
    const std::span bytes(data, size);
    const std::string name = nameOf(bytes);
    if (name == "model.obj")
        checkReducedObj(bytes);
    const auto scene = loadWithAssimp(scratch.write(name, bytes), smallLimits());
    if (!scene) {
        checkError(scene.error());
        return 0;
    }
    checkScene(*scene);
    return 0;
}
