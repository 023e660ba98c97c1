// Godot 3 draws what `cotan shader --lang godot` prints. A door: without godot3 and xvfb-run it is skipped.
#include <gtest/gtest.h>

#include <chrono>

#include <fmt/format.h>

#include "cotan/truth/patch.hpp"
#include "examples_sheets.hpp"
#include "godot_draw.hpp"
#include "godot_parity.hpp"

namespace cotan::test {
namespace {

using shader_text::Choice;
using shader_text::Form;
using shader_text::Language;

class Godot : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Driver, Godot, testing::Values("GLES3", "GLES2"), [](const auto& p) { return p.param; });

TEST_P(Godot, functionsGiveTheNormalsOfTheOtherLanguages)
{
    std::vector<Case> some;
    for (Case& c : godotCases())
        if (!c.light)
            some.push_back(std::move(c));
    std::vector<Sample> finite;
    for (const Sample& s : samples())
        if (s.kind == Kind::sound || s.kind == Kind::degenerate)
            finite.push_back(s);
    const Results r = runGodotCases(some, finite, GetParam());
    for (std::size_t k = 0; k < some.size(); ++k) {
        double most = 0;
        for (std::size_t s = 0; s < finite.size(); ++s)
            if (finite[s].kind <= some[k].last) {
                const glm::dvec3 expected = some[k].expected(finite[s].v);
                const double off = cotan::degreesBetween(r.values[k][s], expected);
                most = off <= most ? most : off; // a NaN stays
            }
        fmt::print("| {:24} | {} | {:.1e} |\n", some[k].name, r.language, most);
        EXPECT_LT(most, 1.2e-3) << some[k].name;
    }
}

} // namespace
} // namespace cotan::test

int main(int count, char** words)
{
    if (std::system("command -v godot3 > /dev/null && command -v xvfb-run > /dev/null") != 0) {
        std::puts("skipped: no godot3 or no xvfb-run");
        return 77;
    }
    testing::InitGoogleTest(&count, words);
    return RUN_ALL_TESTS();
}
