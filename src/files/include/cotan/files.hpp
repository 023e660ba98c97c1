// Limits the resources that a file may use, and selects the process in which untrusted files are read.
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

// Reads untrusted files in a child process: a file that makes a third-party reader crash, hang or use all memory then
// affects only that process. The child is a program of the caller's that begins as follows (cotan/model.hpp),
//
//     int main(int argc, char** argv)
//     {
//         if (cotan::isReaderProcess(argc, argv))
//             return cotan::runReaderProcess();
//
// or that calls runReaderProcess for an argument of its own; the simplest choice is the caller itself, /proc/self/exe.
// If LoadLimits::sandbox names a program, all functions that take LoadLimits use such a child for models other than
// glTF, for images other than PNG and JPEG, and for Draco streams.
//
// Guarantees on Linux: the child has the limits below, none of our descriptors except one socket and a pipe for its
// messages, and no core file. It dies with the thread that started it. Its whole answer is checked before use. If the
// kernel supports Landlock and seccomp, it cannot change files, start programs, signal other processes or open
// connections. On Windows: it has the limits, inherits the pipes to us alone, starts no programs, ends with us, and has
// low integrity, so that it can change hardly any file. Not guaranteed: the child may read every file that the caller
// may read, and their contents may be part of the answer.

struct Sandbox {
    std::filesystem::path program;        // empty: everything is read in this process
    std::vector<std::string> arguments{}; // passed before the reader's own arguments
    // Memory in MiB. 0: 640 (LoadLimits::imageBytes if larger) plus 16 per processor, growing with the file, up to 8
    // GiB or twice the first number.
    std::size_t megabytes = 0;
    // Processor time in seconds. 0: 4, growing with the file, up to an hour. Wall-clock time may be 15 times as long.
    double seconds = 0;
};

// Sets the default of LoadLimits::sandbox; initially files are read in this process. Call it in main() while there is
// only one thread, so that it holds everywhere in the program.
void sandboxByDefault(Sandbox sandbox);
Sandbox defaultSandbox();

// ---- limits --------------------------------------------------------------------------------

struct Image;

// Which images of a model are decoded. Images without pixels have a name but no size.
enum class Pixels {
    all,           // all that are used; an unreadable one is an error
    whereReadable, // the same, except that images in formats that glTF extensions allow but Cotan cannot read
                   // (unreadableFormat in cotan/image.hpp) have no pixels, and a warning names them
    normalMaps,    // likewise, but normal maps only
    none,          // none
};

// The pose in which a glTF model is read.
struct Pose {
    std::string animation; // name or number in the file; empty: the pose of the file's nodes
    double seconds = 0;    // from the animation's start; clamped to its first and last key
};

// The up axis of a model's file.
enum class Up {
    y, // as in a scene
    z, // the model is rotated, see rotateZUpToYUp in scene/geometry.hpp
};

// Limits on the resources that a file may request. A file over a limit is refused before memory is allocated. All
// members have initialisers, so that designated initialisers such as {.pixels = Pixels::none} give no warnings.
struct LoadLimits {
    std::size_t fileBytes = std::size_t(2) << 30; // of the model file or one of its buffers
    std::size_t vertices = 100'000'000;           // of all meshes together
    std::size_t triangles = 100'000'000;          // not counting instances
    std::size_t nodes = 1'000'000;
    // glTF: memory for vertices and triangles beyond 16 times the size of the file and its buffers. A few bytes can
    // request any amount, by accessors without data and by primitives that share them.
    std::size_t geometryBytes = std::size_t(64) << 20;
    int imageSide = 16384;                           // pixels
    std::size_t imageBytes = std::size_t(640) << 20; // one decoded image
    std::size_t allImageBytes =
        std::min<std::uint64_t>(std::uint64_t(8) << 30, SIZE_MAX); // all decoded images of one model
    // Memory for the decoded images of a model, or for a single image, beyond 128 times the size of their files. A few
    // bytes can request any amount; in real images a byte rarely encodes more than eight pixels.
    std::size_t imageBytesBeyond = std::size_t(192) << 20;
    Pixels pixels = Pixels::all; // of a glTF model
    Pose pose = Pose();          // likewise; other formats have no poses. Explicit: otherwise g++ 12 warns in callers
    Up up = Up::y;               // of a model
    bool keepsJpeg = false;      // Image::jpeg receives the file
    std::string variant{};       // material variant of a glTF model, name or number; empty: the file's default
    Sandbox sandbox = defaultSandbox(); // program that reads other models and third-party image formats
    // Called with the number of bytes that are about to be decoded, after it was found to be within the limits; a
    // reader process raises its own limits in it. May be empty.
    std::function<void(std::size_t)> expect{};

    // For a glTF model that is not in files. Both functions may be empty; they are called on the caller's thread.
    // readFile: replaces the disk; returns the bytes of the model, by the name it is opened by, and of its decoded
    // URIs.
    std::function<Result<std::vector<std::byte>>(const std::string& name)> readFile{};
    // Decodes an image file from its bytes, instead of Cotan's own readers; KTX2 is read by these. name: for messages.
    std::function<Result<Image>(std::span<const std::byte> bytes, const std::string& name)> decode{};
};

// Memory that decoded images may take whose files have `fileBytes` bytes.
inline std::size_t imageBudget(const LoadLimits& limits, std::uint64_t fileBytes)
{
    const double bytes = double(limits.imageBytesBeyond) + 128 * double(fileBytes);
    return bytes < double(limits.allImageBytes) ? std::size_t(bytes) : limits.allImageBytes;
}

} // namespace cotan
