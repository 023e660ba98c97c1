#include "godot.hpp"

#include <algorithm>

#include "entry.hpp"
#include "fill.hpp"

namespace cotan::shader_text {

namespace {

bool hasLight(const Choice& choice) { return std::ranges::find(choice.sets, Set::light) != choice.sets.end(); }

// Whether two vectors come with the mesh: U and V of its triangles, or cotangents.
bool hasVectors(const Choice& choice)
{
    return choice.frame == Frame::triangle || readsCotangents(choice.frame);
}

// What fragment() calls; normal is the one of the front.
std::string perturbed(const Choice& choice)
{
    if (choice.frame == Frame::triangle)
        return "cotan_perturb_normal_on_triangle(normal, cotan_u, cotan_v, texture(normal_map, UV).xyz)";
    if (readsCotangents(choice.frame))
        return std::string(kVertexEntry) + "(normal, cotan_u, cotan_v, texture(normal_map, UV).xyz)";
    if (readsVertices(choice.frame))
        return std::string(kVertexEntry) + "(normal, TANGENT, handedness, texture(normal_map, UV).xyz)";
    if (choice.uvSets == 1)
        return std::string(kScreenEntry) + "(normal, VERTEX, UV, texture(normal_map, UV).xyz)";
    return std::string(kScreenEntry)
        + "(normal, VERTEX, UV, texture(normal_map, UV).xyz, UV2,\n        texture(normal_map2, UV2).xyz)";
}

std::string head(const Choice& choice)
{
    std::string text = "shader_type spatial;\n\nuniform sampler2D normal_map : hint_normal;\n";
    if (choice.uvSets > 1)
        text += "uniform sampler2D normal_map2 : hint_normal;\n";
    if (hasLight(choice))
        text += "uniform float coat : hint_range(0.0, 1.0) = 1.0;\n"
                "uniform float coat_roughness : hint_range(0.0, 1.0) = 0.05;\n"
                "varying vec3 cotan_coat_normal;\n";
    if (hasVectors(choice))
        text += "varying vec3 cotan_u;\nvarying vec3 cotan_v;\n";
    return text + '\n';
}

std::string vertex(const Choice& choice)
{
    if (!hasLight(choice) && !hasVectors(choice))
        return "";
    std::string text = "\nvoid vertex()\n{\n";
    if (hasLight(choice))
        text += "    cotan_coat_normal = transpose(inverse(mat3(MODELVIEW_MATRIX))) * NORMAL;\n";
    if (hasVectors(choice))
        text += "    // In Godot 4: CUSTOM0.xyz and CUSTOM1.xyz. For matrices that turn, move and scale evenly.\n"
                "    cotan_u = (MODELVIEW_MATRIX * vec4(TANGENT, 0.0)).xyz;\n"
                "    cotan_v = (MODELVIEW_MATRIX * vec4(COLOR.rgb, 0.0)).xyz;\n";
    return text + "}\n";
}

std::string fragment(const Choice& choice)
{
    std::string text = "\nvoid fragment()\n{\n"
                       "    // With cull_disabled Godot turns NORMAL on back faces. The map is read with the normal of\n"
                       "    // the front and the result turned: a bump in front is a dent behind.\n"
                       "    float side = FRONT_FACING ? 1.0 : -1.0;\n"
                       "    vec3 normal = NORMAL * side;\n";
    if (readsVertices(choice.frame) && !readsCotangents(choice.frame))
        text += "    // BINORMAL points up the image, +v down.\n"
                "    float handedness = dot(cross(normal, TANGENT), BINORMAL) < 0.0 ? 1.0 : -1.0;\n";
    return fill("{}    NORMAL = {} * side;\n}}\n", text, perturbed(choice));
}

// A coat with the normal of the surface without the map. All of the light goes to SPECULAR_LIGHT, which Godot 3 and 4
// both add as it is; LIGHT_COLOR is pi times the light's in both.
constexpr std::string_view kLight = R"(
void light()
{
    vec3 coat_n = normalize(cotan_coat_normal);
    coat_n = dot(coat_n, VIEW) < 0.0 ? -coat_n : coat_n;
    vec3 beneath = cotan_reflect_pbr(ALBEDO, METALLIC, ROUGHNESS, 1.0, vec3(0.0), NORMAL, VIEW, LIGHT);
    float share = cotan_coat_share(coat, coat_roughness, coat_n, VIEW);
    float above = cotan_reflect_coat(coat, coat_roughness, coat_n, VIEW, LIGHT);
    SPECULAR_LIGHT += (beneath * (1.0 - share) + vec3(above)) * LIGHT_COLOR * ATTENUATION;
}
)";

} // namespace

bool isGodotShader(const Choice& choice)
{
    return choice.language == Language::godot && !choice.functionsOnly && !choice.callerDifferences;
}

Status checkGodot(const Choice& choice, Form form)
{
    if (choice.stage != Stage::all && choice.stage != Stage::fragment)
        return usageError("a stage: Godot's vertices do not see each other; expected fragment, the vectors come with "
                          "the mesh");
    if (!isGodotShader(choice))
        return Done{};
    if (info(choice.frame).source == FrameSource::triangle && (choice.frame != Frame::triangle || form != Form::fused))
        return usageError(fill("the frame {}: Godot's shaders do not see a triangle's edges; expected triangle in its "
                               "fused form, or the functions alone",
                               name(choice.frame)));
    if (choice.uvSets > 2)
        return usageError(fill("uv sets: Godot has 2; found {}; expected fewer, or the functions alone", choice.uvSets));
    return Done{};
}

std::string godotNeeds(const Choice& choice)
{
    const bool whole = isGodotShader(choice);
    std::string text = whole ? "// A whole shader of a material; in one of yours, take what is between shader_type and\n"
                               "// fragment() and the lines of fragment(). In Godot 4 take the functions alone (option\n"
                               "// --functions) as a .gdshaderinc.\n//\n"
                             : "// To paste above fragment() of any spatial shader, or in Godot 4 to #include as a\n"
                               "// .gdshaderinc. All vectors are in view space.\n//\n";
    text += "// Needs:\n"
            "//   normal_map an image as it is in the file: imported without sRGB. Green up, as Godot has it\n";
    if (hasVectors(choice))
        return text
            + (choice.frame == Frame::triangle
                   ? "//   u, v       two vectors of each triangle (triangleVectors of cotan/triangle.hpp), at all three\n"
                     "//              of its vertices, which it shares with none\n"
                   : "//   u, v       cotangents at the vertices (deriveVertexFrames of cotan/core)\n")
            + "//              as six floats with the mesh, not compressed: in Godot 3 the arrays of tangents and of\n"
              "//              colours, in Godot 4 those of CUSTOM0 and CUSTOM1. No stored tangents otherwise\n";
    if (readsVertices(choice.frame))
        return text + "//   tangents   in the mesh; TANGENT is unit, so that it is not MikkTSpace's to the last digit\n";
    if (info(choice.frame).source == FrameSource::triangle)
        return text + "//   p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0  the triangle's edges, which a shader does not see\n";
    return text
        + "//   VERTEX     the position in view space, as it is in fragment(); not normalised\n"
          "//   No tangents: switch them off where the mesh is imported. Do not write NORMALMAP (NORMAL_MAP in\n"
          "//   Godot 4), which is the way through stored tangents.\n"
          "//   For ANISOTROPY, behind NORMAL = ...:  TANGENT = cotan_direction_of_u(NORMAL, VERTEX, UV);\n"
          "//                                         BINORMAL = cross(NORMAL, TANGENT);\n";
}

std::string godotShader(const Choice& choice, const std::string& functions)
{
    return head(choice) + functions + vertex(choice) + fragment(choice)
        + (hasLight(choice) ? std::string(kLight) : std::string());
}

} // namespace cotan::shader_text
