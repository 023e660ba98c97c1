// Command lines, one argument per line, in a folder with a small model and a small map. All are parsed; commands that
// take milliseconds are run. File names cannot lead out of the folder.
#include <algorithm>
#include <array>
#include <vector>

#include <fcntl.h>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "files/file_registry.hpp"
#include "fuzz.hpp"

// The tool's own main; see CMakeLists.txt.
int cotanMain(int argc, char** argv);

using namespace cotan;
using namespace cotan::fuzz;

namespace {

constexpr std::size_t kMaxWords = 24;

// Splits at line breaks up to the first NUL, and replaces slashes by underscores.
std::vector<std::string> wordsOf(std::span<const std::uint8_t> bytes)
{
    std::vector<std::string> words(1);
    for (const std::uint8_t byte : bytes) {
        if (byte == 0 || words.size() > kMaxWords)
            break;
        if (byte == '\n')
            words.emplace_back();
        else
            words.back() += byte == '/' ? '_' : char(byte);
    }
    return words;
}

// Other commands draw, bake or measure for seconds: their arguments are only parsed, with an invalid one appended.
constexpr std::array<std::string_view, 5> kQuick = {"shader", "map", "lint", "tangents", "convert"};

const char kTriangle[] = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"material":0}]}],
"materials":[{"normalTexture":{"index":0}}],"textures":[{"source":0}],"images":[{"uri":"map.png"}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"type":"VEC3","count":3},
{"bufferView":2,"componentType":5126,"type":"VEC2","count":3}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},
{"buffer":0,"byteOffset":72,"byteLength":24}],"buffers":[{"byteLength":96,"uri":"data:;base64,)"
                         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAA"
                         "AIA/AAAAAAAAgD8AAIA/AACAPwAAAAAAAAAA\"}]}";

void makeFolder(const Scratch& scratch)
{
    guardInputs(/*overwrite*/ true); // forgets the files of the previous run
    COTAN_HOLDS(bool(writeImage(scratch / "map.png", makeReliefMap(Relief::domes, 8))));
    scratch.write("model.gltf", {reinterpret_cast<const std::uint8_t*>(kTriangle), sizeof kTriangle - 1});
}

int run(std::vector<std::string> words)
{
    words.insert(words.begin(), "cotan");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    return cotanMain(int(words.size()), arguments.data());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Scratch scratch;
    static const bool ready = [] {
        std::filesystem::current_path(scratch.path());
        return ::dup2(::open("/dev/null", O_WRONLY), 1) == 1; // discards the commands' output
    }();
    COTAN_HOLDS(ready);
    std::vector<std::string> words = wordsOf({data, size});
    if (std::ranges::find(kQuick, words.front()) == kQuick.end())
        words.push_back("--no-such-option");
    // Outputs of earlier inputs must not affect this one.
    std::filesystem::remove_all(scratch.path());
    std::filesystem::create_directories(scratch.path());
    std::filesystem::current_path(scratch.path());
    makeFolder(scratch);
    const int code = run(words);
    COTAN_HOLDS(code >= 0 && code <= 5, "{}", code);
    for (const auto& entry : std::filesystem::directory_iterator(scratch.path()))
        COTAN_HOLDS(entry.path().filename().string().find(".part") == std::string::npos, "{} left behind",
                    entry.path().string());
    return 0;
}
