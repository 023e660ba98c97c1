// Which options of a shader text can be combined, and the errors for those that cannot.
#include <gtest/gtest.h>

#include <string>

#include "cotan/shader_text.hpp"

namespace cotan::shader_text {
namespace {

// Both sides of each rule; the error names what was found.
TEST(ShaderForms, incompatibleChoicesAreRefusedByTheirRule)
{
    const auto errorOf = [](Choice choice) {
        const auto made = makeShaderText(choice);
        return made ? "" : made.error().message;
    };
    using F = Frame;
    EXPECT_EQ(errorOf({.uvSets = 0}), "uv sets: expected 1 to 4; found 0");
    EXPECT_EQ(errorOf({.uvSets = 5}), "uv sets: expected 1 to 4; found 5");
    EXPECT_EQ(errorOf({.uvSets = 4}), "");
    EXPECT_EQ(errorOf({.frame = F::smooth, .uvSets = 2}),
              "several uv sets: expected a frame made from differences; found 'smooth'");
    EXPECT_EQ(errorOf({.frame = F::gradient, .form = Form::fused, .uvSets = 2}),
              "the fused form over several uv sets: expected cotangent; found 'gradient'");
    EXPECT_EQ(errorOf({.frame = F::cotangent, .form = Form::fused, .uvSets = 2}), "");
    EXPECT_EQ(errorOf({.frame = F::cotangent, .form = Form::area, .uvSets = 2}),
              "the form area: expected the frame cotangent over one uv set in another language than Godot's; found the "
              "frame cotangent, 2 uv sets, "
                  + std::string(name(Choice().language)));
    for (const Stage stage : {Stage::fragment, Stage::vertex, Stage::mesh, Stage::compute}) {
        const std::string rule = "a stage: expected the frame triangle in its fused form; found another";
        EXPECT_EQ(errorOf({.frame = F::cotangent, .stage = stage}), rule);
        EXPECT_EQ(errorOf({.frame = F::triangle, .form = Form::total, .stage = stage}), rule);
        EXPECT_EQ(errorOf({.frame = F::triangle, .stage = stage}), "");
        EXPECT_EQ(errorOf({.language = Language::godot, .frame = F::triangle, .stage = stage}),
                  stage == Stage::fragment ? ""
                                           : "a stage: Godot's vertex shaders cannot read other vertices; expected "
                                             "fragment, with the vectors in the mesh");
    }
    for (const Set set : kSets) {
        const bool has = set != Set::environment && set != Set::tone && set != Set::shadow;
        EXPECT_EQ(errorOf({.language = Language::godot, .sets = {set}}),
                  has ? ""
                      : "the set " + std::string(name(set))
                          + ": Godot does this itself; expected gradient, blend, space, mapping, parallax or light");
    }
    EXPECT_EQ(errorOf({.language = Language::godot, .uvSets = 2}), "");
    EXPECT_EQ(errorOf({.language = Language::godot, .uvSets = 3}),
              "uv sets: Godot has 2; found 3; expected fewer, or the functions alone");
    EXPECT_EQ(
        errorOf({.language = Language::godot, .frame = F::triangle, .form = Form::total}),
        "the frame triangle: Godot's shaders cannot read a triangle's edges; expected triangle in its fused form, or "
        "the functions alone");
}

} // namespace
} // namespace cotan::shader_text
