// Says how much a file may ask for, and in which process untrusted files are read.
//
//     int main(int argc, char** argv)
//     {
//         if (cotan::isReaderProcess(argc, argv)) // cotan/model.hpp
//             return cotan::runReaderProcess();
//         cotan::sandboxByDefault({.program = "/proc/self/exe"});
//         cotan::LoadLimits limits;
//         limits.imageBytes = std::size_t(64) << 20;
//         auto scene = cotan::loadScene("model.fbx", limits);
//     }
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan {

// ---- reading in a child process ------------------------------------------------------------

// Reading in a child process, so that a file that makes a third-party reader crash, hang or take all memory costs that
// process and not ours. The child is a program of the caller's that begins as follows (cotan/model.hpp),
//
//     int main(int argc, char** argv)
//     {
//         if (cotan::isReaderProcess(argc, argv))
//             return cotan::runReaderProcess();
//
// most simply the caller itself: /proc/self/exe; or that calls runReaderProcess by the word of its own arguments. Where
// LoadLimits::sandbox names it, everything that takes LoadLimits reads models other than glTF, and pictures other than
// PNG and JPEG, through such a child.
//
// What holds, on Linux: the child has the limits below, no descriptors of ours but one socket, and no core file. It
// dies with the thread that started it. What it answers is checked, all of it, before it is used. Where the kernel
// offers Landlock and seccomp it can neither change files nor start programs, signal others or open connections. What
// is not promised: it may read every file that the caller may read, and what it reads may end up in the answer.

struct Sandbox {
    std::filesystem::path program;        // empty: everything is read in this process
    std::vector<std::string> arguments{}; // that it is given before the reader's own
    // MiB of memory; 0: 640 (LoadLimits::imageBytes if more), 16 a processor, more for large files, up to 8 GiB or
    // twice that.
    std::size_t megabytes = 0;
    // Seconds of processor; 0: 4, and more likewise, up to an hour. On the wall it may be fifteen times as long.
    double seconds = 0;
};

// What LoadLimits::sandbox is where nobody sets it; at first, reading in this process. Set it in main(), while there is
// one thread: what a program does not trust, it does not trust anywhere.
void sandboxByDefault(Sandbox sandbox);
Sandbox defaultSandbox();

// ---- limits --------------------------------------------------------------------------------

struct Image;

// Which images of a model are decoded. Images without pixels have a name and no size.
enum class Pixels {
    all,           // those that are used; one that cannot be read is an error
    whereReadable, // the same, but those in a format that glTF extensions allow and nothing here reads (foreignFormat
                   // in cotan/image.hpp) stay without pixels, and a warning names them
    none,          // no image
};

// Which moment of a glTF model is read.
struct Pose {
    std::string animation; // its name, or its number in the file; empty: the pose that the file's nodes have
    double seconds = 0;    // from the animation's start; its first and last key hold before and after
};

// Which axis of a model's file is up.
enum class Up {
    y, // as in a scene
    z, // the model is turned, see turnZUp in scene/geometry.hpp
};

// Limits on what a file may ask for. Over a limit the file is refused before memory is taken. All members have an
// initialiser, so that callers who name some of them, {.pixels = Pixels::none}, get no warning about the others.
struct LoadLimits {
    std::size_t fileBytes = std::size_t(2) << 30; // of the model file or one of its buffers
    std::size_t vertices = 100'000'000;           // of all meshes together
    std::size_t triangles = 100'000'000;          // instances not multiplied
    std::size_t nodes = 1'000'000;
    // glTF: what the vertices and triangles may take in memory beyond sixteen times the size of the file and its
    // buffers. A few bytes can ask for any amount, by accessors without data and by primitives that share them.
    std::size_t geometryBytes = std::size_t(64) << 20;
    int imageSide = 16384;                           // pixels
    std::size_t imageBytes = std::size_t(640) << 20; // decoded, of one image
    std::size_t allImageBytes =
        std::min<std::uint64_t>(std::uint64_t(8) << 30, SIZE_MAX); // decoded, of all images of one model
    // What decoded images, of one model or one alone, may take beyond 128 times the size of their files. A few bytes
    // can ask for any amount; of real pictures a byte rarely stands for more than eight pixels.
    std::size_t imageBytesBeyond = std::size_t(192) << 20;
    Pixels pixels = Pixels::all; // of a glTF model
    Pose pose = Pose();          // likewise; other models have none. Written out: else g++ 12 warns in callers
    Up up = Up::y;               // of a model
    std::string variant{}; // of a glTF model's materials, its name or number in the file; empty: as the file has them
    Sandbox sandbox = defaultSandbox(); // where models other than glTF, and third-party formats of pictures, are read
    // Told of bytes that are about to be decoded, once their number has been found within the limits: how a reader in
    // a process of its own is given room for them. May be empty.
    std::function<void(std::size_t)> expect{};

    // A glTF model that is not in files. Both may be empty, and are called on the thread of the caller.
    // The bytes of the model, by the name that it is opened by, and of what its URIs name, decoded: in place of the
    // disk.
    std::function<Result<std::vector<std::byte>>(const std::string& name)> readFile{};
    // A picture from the bytes of its file, in place of Cotan's own readers; name: for messages.
    std::function<Result<Image>(std::span<const std::byte> bytes, const std::string& name)> decode{};
};

// What images may take, decoded, that were so many bytes in their files.
inline std::size_t imageBudget(const LoadLimits& limits, std::uint64_t fileBytes)
{
    const double bytes = double(limits.imageBytesBeyond) + 128 * double(fileBytes);
    return bytes < double(limits.allImageBytes) ? std::size_t(bytes) : limits.allImageBytes;
}

} // namespace cotan
