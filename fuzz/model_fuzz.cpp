// Models in formats other than glTF: OBJ with its MTL, PLY, COLLADA, STL and 3DS, all in this process. The first bytes
// determine the format; in an OBJ file, what follows the line "#mtl" becomes the library m.mtl beside it. FBX is left
// out: nothing checks the file before Assimp's reader, which can overflow the stack; the tool reads FBX in a child
// process.
#include <algorithm>
#include <string_view>

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
    return "model.obj";
}

// Writes the part after the separator to m.mtl, which always exists, and returns the part before it.
std::span<const std::uint8_t> writeLibrary(const Scratch& scratch, std::span<const std::uint8_t> bytes)
{
    constexpr std::string_view kSeparator = "\n#mtl\n";
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t at = std::min(text.find(kSeparator), bytes.size());
    scratch.write("m.mtl", bytes.subspan(std::min(at + kSeparator.size(), bytes.size())));
    return bytes.subspan(0, at);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Scratch scratch;
    const std::span bytes(data, size);
    const std::string name = nameOf(bytes);
    const auto file = scratch.write(name, name == "model.obj" ? writeLibrary(scratch, bytes) : bytes);
    const auto scene = loadScene(file, smallLimits());
    if (!scene) {
        checkError(scene.error());
        return 0;
    }
    checkScene(*scene);
    const auto again = loadScene(file, smallLimits());
    COTAN_HOLDS(again && again->meshes.size() == scene->meshes.size()
                && again->materials.size() == scene->materials.size());
    for (std::size_t i = 0; i < scene->meshes.size(); ++i)
        COTAN_HOLDS(again->meshes[i].indices == scene->meshes[i].indices, "mesh {}", i);
    return 0;
}
