// The other files in which each frame of the table cotan/frames.inc must appear. Tells the author of a new row what is
// missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cotan/shader_text.hpp"
#include "cotan/tangents.hpp"

namespace cotan {
namespace {

std::string read(const std::string& file)
{
    std::ifstream in(std::string(COTAN_SOURCE_DIR "/") + file);
    std::ostringstream text;
    text << in.rdbuf();
    EXPECT_FALSE(text.str().empty()) << file;
    return text.str();
}

// The frame's row in the table of docs/reference/conventions.md, derived from its properties.
std::string rowOfDocs(const FrameInfo& f)
{
    const char* from = f.source == FrameSource::differences ? "differences"
        : f.source == FrameSource::triangle                 ? "the whole triangle"
        : f.source == FrameSource::cotangents               ? "cotangents at the vertices"
                                                            : "tangents at the vertices";
    const auto yes = [](bool is) { return is ? " yes |" : " no |"; };
    return "| `" + std::string(f.name) + "` | " + from + " |" + yes(f.total) + yes(f.fused) + yes(!f.dependsOnView);
}

struct Requirement {
    std::string file, text; // the file, and what it must contain
};

// A row of the tables, or the sentence about the frame whose code is that of another.
std::string costOf(const FrameInfo& f)
{
    return f.frame == Frame::areaWeighted ? "`area-weighted` costs what `mikktspace`"
                                          : "| " + std::string(f.name) + " ";
}

std::vector<Requirement> requirementsOf(const FrameInfo& f)
{
    const std::string word(f.word), name(f.name);
    const bool historical = read("shaders/cotan/history.h").find(" cotan_frame_" + word + "(") != std::string::npos;
    const std::string text = readsTriangleVectors(f.frame) ? "shaders/cotan/triangle.h"
        : historical                                       ? "shaders/cotan/history.h"
                                                           : "shaders/cotan/frame.h";
    std::vector<Requirement> requirements = {{text, " cotan_frame_" + word + "("},
                                             {"docs/explanation/cost.md", costOf(f)},
                                             {"docs/reference/conventions.md", rowOfDocs(f)},
                                             {"docs/accuracy.csv", "," + name + ","},
                                             {"tests/portable_main.glsl", "cotan_frame_" + word + "("},
                                             {"tests/portable_main.hlsl", "cotan_frame_" + word + "("}};
    if (f.fused)
        for (const char* file : {"shaders/cotan/fused.h", "tests/portable_main.glsl", "tests/portable_main.hlsl"})
            requirements.push_back({file, "cotan_perturb_" + word + "("});
    return requirements;
}

// One line for each file that lacks the frame.
std::vector<std::string> missing(const FrameInfo& f)
{
    std::vector<std::string> lines;
    for (const Requirement& need : requirementsOf(f))
        if (read(need.file).find(need.text) == std::string::npos)
            lines.push_back(std::string(f.name) + ": expected '" + need.text + "' in " + need.file + "; found none");
    return lines;
}

TEST(FrameTable, everyFileThatListsFramesHasEachFrame)
{
    for (const FrameInfo& f : frames())
        for (const std::string& line : missing(f))
            ADD_FAILURE() << line;
}

TEST(FrameTable, anUnknownFrameIsMissingFromEveryFile)
{
    const FrameInfo unknown{Frame::cotangent,
                            "no-such",
                            "no_such",
                            FrameSource::differences,
                            /*total=*/true,
                            /*dependsOnView=*/false,
                            FrameNormal::frame,
                            true,
                            "",
                            ""};
    EXPECT_EQ(missing(unknown).size(), requirementsOf(unknown).size());
}

TEST(FrameTable, aFusedFormIsDeclaredIfItExists)
{
    const std::string text = read("shaders/cotan/fused.h");
    for (const FrameInfo& f : frames())
        EXPECT_EQ(text.find("cotan_perturb_" + std::string(f.word) + "(") != std::string::npos, f.fused) << f.name;
}

// Shader text and cost tables test for no particular frame. Exceptions: `cotangent`, the default, which alone has the
// forms `seen` and `area`; `gradient`, the reference for sums of gradients; `orthonormal`, which replaces tangents that
// a mesh lacks; `mikktspace`, with which costs are compared, and `area-weighted`, whose code is the same; and the four
// frames whose instructions the chapter of 2006 counted.
TEST(FrameTable, textAndCostNameOnlyTheExceptedFrames)
{
    const std::map<std::string, std::set<std::string>> exceptions = {
        {"src/shader_text", {"cotangent", "gradient", "orthonormal"}},
        {"apps/lab/cost",
         {"mikktspace", "areaWeighted", "paperFull", "paperNodet", "paperTranspose", "paperOrthogonal"}},
        {"apps/lab/report", {}}};
    for (const auto& [folder, allowed] : exceptions)
        for (const auto& file : std::filesystem::directory_iterator(std::string(COTAN_SOURCE_DIR "/") + folder)) {
            if (file.path().extension() != ".cpp" && file.path().extension() != ".hpp")
                continue;
            const std::string name = folder + "/" + file.path().filename().string(), text = read(name);
#define COTAN_FRAME_ROW(number, enumerator, ...)                                                                       \
    EXPECT_TRUE(allowed.contains(#enumerator) || text.find("Frame::" #enumerator) == std::string::npos)                \
        << name << " asks for " #enumerator;
#include "cotan/frames.inc"
        }
}

TEST(FrameTable, theDocumentListsNoUnknownFrame)
{
    std::istringstream text(read("docs/reference/conventions.md"));
    std::size_t rows = 0;
    bool inside = false;
    for (std::string line; std::getline(text, line);) {
        inside = line.starts_with("## ") ? line == "## Frames by name" : inside;
        rows += inside && line.starts_with("| `");
    }
    EXPECT_EQ(rows, frames().size());
}

TEST(FrameTable, theShaderTextOfEachFrameContainsItsFunction)
{
    for (const FrameInfo& f : frames())
        for (const shader_text::Language language : shader_text::kLanguages)
            for (const shader_text::Form form : {shader_text::Form::total, shader_text::Form::fused}) {
                shader_text::Choice choice;
                choice.language = language;
                choice.frame = f.frame;
                choice.form = form;
                choice.functionsOnly = true; // a whole Godot shader cannot access edges
                const auto made = makeShaderText(choice);
                const bool fused = form == shader_text::Form::fused;
                ASSERT_EQ(bool(made), !fused || f.fused) << f.name;
                if (made) {
                    const std::string function = (fused ? "cotan_perturb_" : "cotan_frame_") + std::string(f.word);
                    EXPECT_EQ(std::ranges::count(made->functions, function), 1) << f.name << ", " << name(language);
                }
            }
}

// On a triangle in xy with u along x, every generator must give the same tangent.
TEST(FrameTable, framesThatReadTangentsHaveAGenerator)
{
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, normals(3, {0, 0, 1});
    const std::vector<glm::vec2> uv = {{0, 1}, {1, 1}, {0, 0}};
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    for (const FrameInfo& f : frames()) {
        const auto tangents = generateTangents(f.frame, {positions, normals, uv, indices});
        ASSERT_EQ(tangents.size(), readsTangents(f.frame) ? 3u : 0u) << f.name;
        for (const glm::vec4& t : tangents)
            EXPECT_EQ(t, glm::vec4(1, 0, 0, 1)) << f.name; // v points down: cross(n, t) points up the image
    }
}

} // namespace
} // namespace cotan
