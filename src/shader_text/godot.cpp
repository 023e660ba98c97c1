#include "entry.hpp"

namespace cotan::shader_text {

namespace {

bool hasLight(const Choice& choice) { return hasSet(choice, Set::light); }

// Whether the mesh supplies two vectors: U and V of its triangles, or cotangents.
bool hasVectors(const Choice& choice) { return readsTriangleVectors(choice.frame) || readsCotangents(choice.frame); }

// Whether fragment() takes derivatives, which OpenGL ES 2 lacks.
bool isMadeOfDerivatives(const Choice& choice) { return info(choice.frame).source == FrameSource::differences; }

// Returns the call in fragment() that perturbs the normal.
std::string perturbed(const Choice& choice, const std::string& normal)
{
    const std::string texel = "texture(normal_map, UV).xyz";
    if (!isMadeOfDerivatives(choice)) {
        const bool orScreen = !choice.callerDifferences;
        return fill("{}({}{}, {}, {})", orScreen ? kScreenEntry : entryOf(choice), normal,
                    orScreen ? ", VERTEX, UV" : "", readsTangents(choice.frame) ? "t, w" : "cotan_u, cotan_v", texel);
    }
    if (choice.uvSets == 1)
        return fill("{}({}, VERTEX, UV, {})", kScreenEntry, normal, texel);
    return fill("{}({}, VERTEX, UV, {}, UV2,\n        texture(normal_map2, UV2).xyz)", kScreenEntry, normal, texel);
}

bool readsNormal(const Choice& choice) { return hasLight(choice) || choice.twoSided; }

// The start of the call in vertex() that transforms the vectors of the mesh.
std::string_view inView(const Choice& choice)
{
    return readsCotangents(choice.frame) ? "cotan_smooth_in_view(NORMAL, " : "cotan_triangle_in_view(";
}

std::string head(const Choice& choice)
{
    std::string text = "shader_type spatial;\n";
    if (choice.twoSided)
        text += "render_mode cull_disabled;\n";
    text += "\nuniform sampler2D normal_map : hint_normal;\n";
    if (choice.uvSets > 1)
        text += "uniform sampler2D normal_map2 : hint_normal;\n";
    if (hasLight(choice))
        text += "uniform float metallic : hint_range(0.0, 1.0) = 0.0;\n"
                "uniform float coat : hint_range(0.0, 1.0) = 1.0;\n"
                "uniform float coat_roughness : hint_range(0.0, 1.0) = 0.05;\n";
    if (readsNormal(choice))
        text += "varying vec3 cotan_normal;\n";
    if (choice.twoSided && !isMadeOfDerivatives(choice))
        text += "varying float cotan_side;\n";
    if (hasVectors(choice))
        text += "varying vec3 cotan_u;\nvarying vec3 cotan_v;\n";
    if (readsTangents(choice.frame))
        text += "varying float cotan_given;\n";
    return text + '\n';
}

std::string vertex(const Choice& choice)
{
    std::string text;
    if (readsNormal(choice)) // inverse() is wrong in the GLES2 of Godot 3.2
        text += "    vec3 x = MODELVIEW_MATRIX[0].xyz;\n"
                "    vec3 y = MODELVIEW_MATRIX[1].xyz;\n"
                "    vec3 z = MODELVIEW_MATRIX[2].xyz;\n"
                "    float side = dot(cross(x, y), z) < 0.0 ? -1.0 : 1.0; // -1: it mirrors\n"
                "    vec3 n = cross(y, z) * NORMAL.x + cross(z, x) * NORMAL.y + cross(x, y) * NORMAL.z;\n"
                "    cotan_normal = normalize(n * side);\n";
    if (choice.twoSided && !isMadeOfDerivatives(choice))
        text += "    cotan_side = side;\n";
    if (hasVectors(choice))
        text += fill("    // In Godot 4: CUSTOM0.xyz and CUSTOM1.xyz.\n"
                     "    vec3 u;\n    vec3 v;\n"
                     "    {}TANGENT, COLOR.rgb, MODELVIEW_MATRIX[0].xyz, MODELVIEW_MATRIX[1].xyz,\n"
                     "        MODELVIEW_MATRIX[2].xyz, u, v);\n"
                     "    cotan_u = u;\n    cotan_v = v;\n",
                     inView(choice));
    if (readsTangents(choice.frame))
        text += "    cotan_given = dot(TANGENT, TANGENT) > 0.0 ? 1.0 : 0.0;\n";
    return text.empty() ? text : "\nvoid vertex()\n{\n" + text + "}\n";
}

std::string fragment(const Choice& choice)
{
    const std::string normal = choice.twoSided ? "cotan_normal" : "NORMAL";
    std::string text = "\nvoid fragment()\n{\n";
    if (hasLight(choice))
        text += "    METALLIC = metallic; // Godot 3 does not pass it to light()\n";
    if (choice.twoSided && isMadeOfDerivatives(choice))
        text += "    // Seen from behind? FRONT_FACING is inverted in Godot 3 where the transform mirrors.\n"
                "    vec3 seen = cross(dFdx(VERTEX), dFdy(VERTEX));\n"
                "    vec3 away = mix(VERTEX, vec3(0.0, 0.0, -1.0), PROJECTION_MATRIX[3][3]); // from the eye\n"
                "    float side = dot(cotan_normal, seen) * dot(seen, away) > 0.0 ? -1.0 : 1.0;\n";
    else if (choice.twoSided)
        text += "    // FRONT_FACING is inverted where the transform mirrors.\n"
                "    float side = FRONT_FACING ? cotan_side : -cotan_side;\n";
    if (readsTangents(choice.frame))
        text += fill("    vec3 t = cotan_given > 0.5 ? TANGENT : vec3(0.0);\n"
                     "    // BINORMAL points up the image, as glTF's bitangent does.\n"
                     "    float w = dot(cross({}, t), BINORMAL) < 0.0 ? -1.0 : 1.0;\n",
                     normal);
    return fill("{}    NORMAL = {}{};\n}}\n", text, perturbed(choice, normal), choice.twoSided ? " * side" : "");
}

// A coat over the surface, with the normal without the map. All light is added to SPECULAR_LIGHT, which Godot 3 and 4
// add unchanged; LIGHT_COLOR is pi times the light's colour in both.
constexpr std::string_view kLight = R"(
void light()
{
    vec3 coat_n = normalize(cotan_normal);
    coat_n = dot(coat_n, VIEW) < 0.0 ? -coat_n : coat_n;
    vec3 beneath = cotan_reflect_pbr(ALBEDO, metallic, ROUGHNESS, 1.0, vec3(0.0), NORMAL, VIEW, LIGHT);
    float share = cotan_coat_fraction(coat, coat_roughness, coat_n, VIEW);
    float above = cotan_reflect_coat(coat, coat_roughness, coat_n, VIEW, LIGHT);
    SPECULAR_LIGHT += (beneath * (1.0 - share) + vec3(above)) * LIGHT_COLOR * ATTENUATION;
}
)";

} // namespace

bool isGodotShader(const Choice& choice)
{
    const bool fromMesh = readsVertices(choice.frame) || readsTriangleVectors(choice.frame);
    return choice.language == Language::godot && !choice.functionsOnly && (fromMesh || !choice.callerDifferences);
}

Status checkGodot(const Choice& choice, Form form)
{
    if (choice.stage != Stage::all && choice.stage != Stage::fragment)
        return usageError("a stage: Godot's vertex shaders cannot read other vertices; expected fragment, with the "
                          "vectors in the mesh");
    if (!isGodotShader(choice))
        return Done{};
    if (info(choice.frame).source == FrameSource::triangle
        && (!readsTriangleVectors(choice.frame) || form != Form::fused))
        return usageError(fill("the frame {}: Godot's shaders cannot read a triangle's edges; expected triangle in its "
                               "fused form, or the functions alone",
                               name(choice.frame)));
    if (choice.uvSets > 2)
        return usageError(
            fill("uv sets: Godot has 2; found {}; expected fewer, or the functions alone", choice.uvSets));
    return Done{};
}

std::vector<std::string> functionsOfLight()
{
    return {"cotan_reflect_pbr", "cotan_coat_fraction", "cotan_reflect_coat"};
}

std::string godotNeeds(const Choice& choice, Form form)
{
    const bool whole = isGodotShader(choice);
    std::string text = whole
        ? "// A complete material shader. To use it in your own, copy what is between shader_type and\n"
          "// fragment() and the lines of fragment(). In Godot 4 use the functions alone (option\n"
          "// --functions) as a .gdshaderinc.\n//\n"
        : "// To paste above fragment() of any spatial shader, or in Godot 4 to #include as a\n"
          "// .gdshaderinc. All vectors are in view space.\n//\n";
    text += "// Needs:\n"
            "//   normal_map the values of the file: imported without sRGB. Green up, as Godot expects\n";
    const std::string drawn = hasSubstitute(choice, form)
        ? fill("is drawn with `{}`, from derivatives. For the driver\n"
               "//   GLES2 of Godot 3, which has none, print with --differences caller: there it has no bumps.\n",
               name(substituteOf(choice.frame)))
        : "has no bumps. With --differences shader it is drawn with\n//   another frame.\n";
    const bool triangle = readsTriangleVectors(choice.frame) && form == Form::fused;
    if (triangle || readsCotangents(choice.frame)) {
        text += triangle
            ? "//   u, v       two vectors of each triangle (triangleVectors of cotan/triangle.hpp), at all three\n"
              "//              of its vertices, which belong to it alone\n"
            : "//   u, v       cotangents at the vertices (smoothCotangents of cotan/tangents.hpp)\n";
        text +=
            "//              as six floats with the mesh, not compressed: in Godot 3 the arrays of tangents and of\n"
            "//              colours, in Godot 4 those of CUSTOM0 and CUSTOM1. No stored tangents otherwise\n";
        if (!whole)
            text += fill("//   In vertex(), for two varyings, with CUSTOM0.xyz and CUSTOM1.xyz in Godot 4:\n"
                         "//     {}TANGENT, COLOR.rgb, MODELVIEW_MATRIX[0].xyz, MODELVIEW_MATRIX[1].xyz,\n"
                         "//       MODELVIEW_MATRIX[2].xyz, u, v);\n",
                         inView(choice));
        return text + "//\n// Missing:\n//   A mesh without u and v " + drawn
            + "//   In Godot 3 no shader can tell them from stored tangents in a mesh that has colours, too"
            + (triangle ? "\n//   (dark ones): its bumps are wrong.\n" : ": its\n//   bumps are wrong.\n");
    }
    if (readsVertices(choice.frame))
        return text
            + "//   tangents   in the mesh; TANGENT is normalised, so it is not exactly MikkTSpace's\n"
              "//\n// Missing:\n//   In Godot 3 a mesh without tangents "
            + drawn
            + "//   Godot 4 invents tangents that do not follow the uv, and no shader can tell: the bumps are wrong.\n"
              "//   Turn on Ensure Tangents in the import of the mesh, or print the frame orthonormal.\n";
    if (info(choice.frame).source == FrameSource::triangle)
        return text + "//   p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0  the triangle's edges, which a shader cannot read\n";
    return text
        + "//   VERTEX     the position in view space, as it is in fragment(); not normalised\n"
          "//   dFdx, dFdy In Godot 3 the driver GLES3: GLES2 has none. The frames triangle and smooth need none\n"
          "//              with --differences caller\n"
          "//   No tangents: disable them in the import of the mesh. Do not write NORMALMAP (NORMAL_MAP in\n"
          "//   Godot 4), which uses stored tangents.\n"
          "//   For ANISOTROPY, after NORMAL = ...:   TANGENT = cotan_direction_of_u(NORMAL, VERTEX, UV);\n"
          "//                                         BINORMAL = cross(NORMAL, TANGENT);\n";
}

std::string godotShader(const Choice& choice, const std::string& functions)
{
    return head(choice) + functions + vertex(choice) + fragment(choice)
        + (hasLight(choice) ? std::string(kLight) : std::string());
}

} // namespace cotan::shader_text
