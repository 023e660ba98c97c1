#include "entry.hpp"

namespace cotan::shader_text {

namespace {

// Returns the expression for the normal that the frame requires.
std::string normalFor(Frame frame)
{
    return info(frame).normal == FrameNormal::caller ? "normal * cotan_inversesqrt(dot(normal, normal))" : "normal";
}

std::string fromVertices(Frame frame, Form form)
{
    const bool covectors = readsCotangents(frame);
    const std::string arguments =
        covectors ? "cotan_vec3 cotangent, cotan_vec3 cobitangent" : "cotan_vec3 tangent, cotan_real w";
    const std::string what = covectors
        ? std::string(
              "// cotangent, cobitangent: covectors averaged at the vertices, interpolated, in normal's space.\n")
            + (form == Form::fused ? "// At the vertices the normal has length 1, and so has the longer of the two "
                                     "covectors, also after\n"
                                     "// a transform that scales.\n"
                                   : "// Any common scale.\n")
        : "// tangent, w: glTF's TANGENT; its xyz interpolated, in normal's space. w, +1 or -1, is what glTF stores:\n"
          "// w * cross(normal, tangent) points against +v. Where yours points along +v, as after a transform that\n"
          "// mirrors, pass its negative.\n"
            + std::string(
                info(frame).normal == FrameNormal::nobody
                    ? "// At the vertices normal and tangent have length 1, also after a transform that scales.\n"
                    : "");
    const std::string head = fill("// The perturbed normal, unit.\n"
                                  "// normal: interpolated.\n{}"
                                  "// texel: the normal map as sampled.\n"
                                  "COTAN_FUNCTION cotan_vec3 {}(cotan_vec3 normal, {}, cotan_vec3 texel)\n{{\n"
                                  "    cotan_vec3 m = cotan_decode(texel);\n",
                                  what, entryOf(frame), arguments);
    const std::string attributes = covectors ? "cotangent, cobitangent" : "tangent, -w";
    if (form == Form::fused)
        return fill("{}    return cotan_perturb_{}(normal, {}, m);\n}}\n", head, info(frame).word, attributes);
    return fill("{}    cotan_frame frame = cotan_frame_{}(normal, {});\n"
                "    return cotan_apply(frame, m);\n}}\n",
                head, info(frame).word, attributes);
}

// Computes U and V of a triangle, in a stage before the pixel stage.
const char* const kTriangleMaker =
    "// U and V of a triangle as three words of two half floats each, 12 bytes.\n"
    "// p0 p1 p2: the triangle's corners in the space of the frame. Their order does not matter.\n"
    "// uv0 uv1 uv2: the uv of the normal map. n0 n1 n2: vertex normals, which define the outside.\n"
    "COTAN_FUNCTION cotan_packed_triangle cotan_make_triangle(cotan_vec3 p0, cotan_vec3 p1, cotan_vec3 p2, "
    "cotan_vec2 uv0, cotan_vec2 uv1, cotan_vec2 uv2, cotan_vec3 n0, cotan_vec3 n1, cotan_vec3 n2)\n{\n"
    "    cotan_triangle vectors = cotan_triangle_of_sound_edges(p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0, n0 + n1 + "
    "n2);\n"
    "    return cotan_pack_triangle(vectors.u, vectors.v);\n}\n";

// The pixel stage, for the frame {}.
const char* const kTrianglePixel =
    "// The perturbed normal, unit.\n"
    "// normal: interpolated. On back faces leave it as it is and negate the result.\n"
    "// words: the result of cotan_make_triangle, the same at every pixel of the triangle.\n"
    "// texel: the normal map as sampled.\n"
    "COTAN_FUNCTION cotan_vec3 cotan_perturb_normal_on_triangle(cotan_vec3 normal, cotan_packed_triangle words, "
    "cotan_vec3 texel)\n{{\n"
    "    cotan_vec3 m = cotan_decode(texel);\n"
    "    cotan_vec3 u = cotan_unpack_triangle_u(words);\n"
    "    cotan_vec3 v = cotan_unpack_triangle_v(words);\n"
    "    return cotan_perturb_{}(normal, u, v, m);\n}}\n";

// The pixel stage for languages that cannot unpack halfs.
const char* const kTriangleVectorsPixel =
    "// The perturbed normal, unit.\n"
    "// normal: interpolated. On back faces leave it as it is and negate the result.\n"
    "// u, v: the vectors of the triangle, the same at every pixel of it, in normal's space.\n"
    "// texel: the normal map as sampled.\n"
    "COTAN_FUNCTION cotan_vec3 cotan_perturb_normal_on_triangle(cotan_vec3 normal, cotan_vec3 u, cotan_vec3 v, "
    "cotan_vec3 texel)\n{{\n"
    "    return cotan_perturb_{}(normal, u, v, cotan_decode(texel));\n}}\n";

// Godot's vertex(): the vectors of the mesh in view space, of length 1 whatever the transform scales.
const char* const kTriangleInView =
    "// U and V in view space, for vertex(). Exact for every transform that has an inverse.\n"
    "// u, v: as the mesh stores them: the longer has length 1. Anything else counts as missing and gives 0, such as\n"
    "// zeros, or the white that a mesh without colours has.\n"
    "// x, y, z: the columns MODELVIEW_MATRIX[0].xyz, MODELVIEW_MATRIX[1].xyz, MODELVIEW_MATRIX[2].xyz.\n"
    "COTAN_FUNCTION cotan_triangle cotan_triangle_in_view(cotan_vec3 u, cotan_vec3 v, cotan_vec3 x, cotan_vec3 y, "
    "cotan_vec3 z)\n{\n"
    "    cotan_real longest2 = max(dot(u, u), dot(v, v));\n"
    "    cotan_real given = abs(longest2 - cotan_real(1.0)) < cotan_real(0.01) ? cotan_real(1.0) : cotan_real(0.0);\n"
    "    cotan_triangle object;\n"
    "    object.u = u * given;\n"
    "    object.v = v * given;\n"
    "    return cotan_triangle_transformed(object, cotan_vec3(x.x, y.x, z.x), cotan_vec3(x.y, y.y, z.y), "
    "cotan_vec3(x.z, y.z, z.z), cotan_sign(dot(cross(x, y), z)));\n}\n";
const char* const kSmoothInView =
    "// The cotangents of a vertex in view space, for vertex(). Exact for every transform that has an inverse.\n"
    "// normal, t, b: as the mesh stores them. White for b, which a mesh without colours has, counts as missing and\n"
    "// gives 0, like zeros.\n"
    "// x, y, z: the columns MODELVIEW_MATRIX[0].xyz, MODELVIEW_MATRIX[1].xyz, MODELVIEW_MATRIX[2].xyz.\n"
    "COTAN_FUNCTION cotan_covectors cotan_smooth_in_view(cotan_vec3 normal, cotan_vec3 t, cotan_vec3 b, cotan_vec3 x, "
    "cotan_vec3 y, cotan_vec3 z)\n{\n"
    "    cotan_vec3 yz = cross(y, z);\n"
    "    cotan_vec3 zx = cross(z, x);\n"
    "    cotan_vec3 xy = cross(x, y);\n"
    "    cotan_real side = cotan_sign(dot(x, yz));\n"
    "    cotan_vec3 white = cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(1.0));\n"
    "    cotan_real given = cotan_sum_abs(b - white) > cotan_real(0.0) ? side : cotan_real(0.0);\n"
    "    cotan_frame frame = cotan_frame_smooth((yz * normal.x + zx * normal.y + xy * normal.z) * side, "
    "(yz * t.x + zx * t.y + xy * t.z) * given, (yz * b.x + zx * b.y + xy * b.z) * given);\n"
    "    cotan_covectors view;\n    view.t = frame.t;\n    view.b = frame.b;\n    return view;\n}\n";

// The additional parameter of the form `seen`.
const char* const kSideParameter = ", cotan_real side";
const char* const kSide =
    "// normal must be on the visible side: flipped on back faces.\n"
    "// side: +1 if cross(dpdx, dpdy) of visible surfaces points towards the viewer, otherwise -1; one constant for\n"
    "// everything drawn. In right-handed spaces -1 where rows of pixels run down (Vulkan, Direct3D, Metal, WebGPU),\n"
    "// +1 where they run up (OpenGL, WebGL). The opposite in left-handed spaces, and where the image is flipped.\n";

std::string fromDifferences(Frame frame, Form form)
{
    const bool edges = info(frame).source == FrameSource::triangle;
    const std::string what = edges
        ? "// normal: interpolated at the shaded point.\n"
          "// dpdx, dpdy: the triangle's edges p1 - p0 and p2 - p0, in normal's space.\n"
          "// duvdx, duvdy: uv1 - uv0 and uv2 - uv0.\n"
        : "// normal: interpolated.\n"
          "// dpdx, dpdy: differences of position along any two directions, in normal's space.\n"
          "// duvdx, duvdy: differences of uv along the same two.\n";
    const bool seen = form == Form::seen;
    const std::string head = fill("// The perturbed normal, unit.\n{}"
                                  "// texel: the normal map as sampled.\n"
                                  "COTAN_FUNCTION cotan_vec3 {}(cotan_vec3 normal, cotan_vec3 dpdx, cotan_vec3 dpdy, "
                                  "cotan_vec2 duvdx, cotan_vec2 duvdy, cotan_vec3 texel{})\n{{\n"
                                  "    cotan_vec3 m = cotan_decode(texel);\n",
                                  what + (seen ? kSide : ""), entryOf(frame), seen ? kSideParameter : "");
    if (form == Form::fused && edges)
        return fill("{}    cotan_triangle vectors = cotan_triangle_of_sound_edges(dpdx, dpdy, duvdx, duvdy, normal);\n"
                    "    return cotan_perturb_{}(normal, vectors.u, vectors.v, m);\n}}\n",
                    head, info(frame).word);
    if (form != Form::total)
        return fill("{}    return cotan_perturb_{}{}(normal, dpdx, dpdy, duvdx, duvdy, m{});\n}}\n", head,
                    info(frame).word,
                    seen                     ? "_seen"
                        : form == Form::area ? "_area"
                                             : "",
                    seen ? ", side" : "");
    return fill("{}    cotan_frame frame = cotan_frame_{}({}, dpdx, dpdy, duvdx, duvdy);\n"
                "    return cotan_apply(frame, m);\n}}\n",
                head, info(frame).word, normalFor(frame));
}

std::string ofTriangle(const Choice& choice)
{
    const std::string fromEdges = fromDifferences(choice.frame, Form::fused);
    if (choice.language == Language::godot) {
        const bool pixelOnly = isGodotShader(choice) || choice.stage == Stage::fragment;
        return std::string(kTriangleInView) + "\n" + fill(kTriangleVectorsPixel, info(choice.frame).word)
            + (pixelOnly ? "" : "\n" + fromEdges);
    }
    const std::string pixel = fill(kTrianglePixel, info(choice.frame).word);
    switch (choice.stage) {
    case Stage::fragment: return pixel;
    case Stage::vertex:
    case Stage::mesh: return kTriangleMaker;
    case Stage::compute: return fromEdges;
    case Stage::all: break;
    }
    return std::string(kTriangleMaker) + "\n" + pixel + "\n" + fromEdges;
}

// Returns the pattern once for every uv set, with the number of the set for {0}.
std::string perSet(int sets, std::string_view pattern)
{
    std::string text;
    for (int k = 0; k < sets; ++k)
        text += fill(pattern, k);
    return text;
}

// Returns "slope0 + slope1" for the word slope.
std::string sumOfSets(int sets, std::string_view word) { return perSet(sets, fill(" + {}{{0}}", word)).substr(3); }

std::string fromSeveralSets(Frame frame, Form form, int sets)
{
    std::string text =
        fill("// The perturbed normal, unit: the bumps of {} normal maps, each over a uv set of its own,\n"
             "// added as surface gradients.\n"
             "// normal: interpolated.\n"
             "// dpdx, dpdy: differences of position along any two directions, in normal's space.\n"
             "// duvKdx, duvKdy: differences of uv set K along the same two.\n"
             "// texelK: its normal map as sampled.\n"
             "COTAN_FUNCTION cotan_vec3 {}(cotan_vec3 normal, cotan_vec3 dpdx, cotan_vec3 dpdy{})\n{{\n",
             sets, kEntry, perSet(sets, ", cotan_vec2 duv{0}dx, cotan_vec2 duv{0}dy, cotan_vec3 texel{0}"));
    if (form == Form::fused) {
        text += "    cotan_footprint footprint = cotan_footprint_of(normal, dpdx, dpdy);\n";
        text += perSet(sets,
                       "    cotan_vec2 slope{0} = "
                       "cotan_footprint_slope(footprint, duv{0}dx, duv{0}dy, cotan_decode(texel{0}));\n");
        return text + fill("    return cotan_perturb_footprint(footprint, {});\n}}\n", sumOfSets(sets, "slope"));
    }
    text += fill("    cotan_vec3 n = {};\n", normalFor(frame));
    for (int k = 0; k < sets; ++k)
        text += fill("    cotan_frame frame{0} = cotan_frame_{1}(n, dpdx, dpdy, duv{0}dx, duv{0}dy);\n"
                     "    cotan_vec3 gradient{0} = cotan_gradient_of_slope(frame{0}, "
                     "cotan_slope_of_texel(cotan_decode(texel{0})));\n",
                     k, info(frame).word);
    return text + fill("    return cotan_resolve_gradient(frame0.n, {});\n}}\n", sumOfSets(sets, "gradient"));
}

std::string fromScreen(int sets, Form form)
{
    const bool one = sets == 1, seen = form == Form::seen;
    return fill("\n// The same, taking the screen derivatives itself: call it in uniform control flow, before any\n"
                "// branch or discard that differs within a 2x2 quad.\n"
                "// position: camera-relative, interpolated, not normalised.\n"
                "COTAN_FUNCTION cotan_vec3 {}(cotan_vec3 normal, cotan_vec3 position{}{})\n{{\n"
                "    return {}(normal, cotan_ddx(position), cotan_ddy(position){}{});\n}}\n",
                kScreenEntry,
                one ? ", cotan_vec2 uv, cotan_vec3 texel" : perSet(sets, ", cotan_vec2 uv{0}, cotan_vec3 texel{0}"),
                seen ? kSideParameter : "", kEntry,
                one ? ", cotan_ddx(uv), cotan_ddy(uv), texel"
                    : perSet(sets, ", cotan_ddx(uv{0}), cotan_ddy(uv{0}), texel{0}"),
                seen ? ", side" : "");
}

// Godot: the function for meshes of which some lack what the frame reads, and the one of the frame that replaces it.
std::string orFromScreen(const Choice& choice)
{
    const Frame other = substituteOf(choice.frame);
    const bool tangents = readsTangents(choice.frame);
    const std::string_view names = tangents ? "tangent, w"
        : readsCotangents(choice.frame)     ? "cotangent, cobitangent"
                                            : "u, v";
    const std::string_view first = names.substr(0, names.find(',')), second = names.substr(names.find(' ') + 1);
    return "\n" + fromDifferences(other, Form::fused)
        + fill("\n// The same for meshes of which some lack them: {0} gives `{1}` from screen derivatives. Call it in\n"
               "// uniform control flow, before any branch or discard that differs within a 2x2 quad.\n"
               "// position: camera-relative, interpolated, not normalised. uv: those of the map.\n"
               "COTAN_FUNCTION cotan_vec3 {2}(cotan_vec3 normal, cotan_vec3 position, cotan_vec2 uv, cotan_vec3 {3}, "
               "{4} {5}, cotan_vec3 texel)\n{{\n"
               "    cotan_vec3 dpdx = cotan_ddx(position);\n    cotan_vec3 dpdy = cotan_ddy(position);\n"
               "    cotan_vec2 duvdx = cotan_ddx(uv);\n    cotan_vec2 duvdy = cotan_ddy(uv);\n"
               "    if ({6} > cotan_real(0.0))\n"
               "        return {7}(normal, {3}, {5}, texel);\n"
               "    return {8}(normal, dpdx, dpdy, duvdx, duvdy, texel);\n}}\n",
               tangents ? std::string("tangent = 0") : fill("{} = {} = 0", first, second), name(other), kScreenEntry,
               first, tangents ? "cotan_real" : "cotan_vec3", second,
               tangents ? std::string("dot(tangent, tangent)") : fill("dot({0}, {0}) + dot({1}, {1})", first, second),
               readsTriangleVectors(choice.frame) ? std::string("cotan_perturb_normal_on_triangle")
                                                  : entryOf(choice.frame),
               kEntry);
}

// The direction that Godot's ANISOTROPY requires.
const char* const kDirectionOfU =
    "\n// The direction along increasing u on the surface, unit, perpendicular to n; zero for constant uv. For "
    "ANISOTROPY.\n"
    "// n: the perturbed normal. position, uv: as above.\n"
    "COTAN_FUNCTION cotan_vec3 cotan_direction_of_u(cotan_vec3 n, cotan_vec3 position, cotan_vec2 uv)\n{\n"
    "    cotan_vec2 duvdx = cotan_ddx(uv);\n"
    "    cotan_vec2 duvdy = cotan_ddy(uv);\n"
    "    cotan_vec3 u = cotan_ddx(position) * duvdy.y - cotan_ddy(position) * duvdx.y;\n"
    "    cotan_vec3 along = u - n * dot(n, u);\n"
    "    cotan_real scale = cotan_inversesqrt(max(dot(along, along), cotan_real(1e-36)));\n"
    "    return along * cotan_copy_sign(scale, duvdx.x * duvdy.y - duvdx.y * duvdy.x);\n}\n";

} // namespace

std::string entryOf(Frame frame)
{
    switch (info(frame).source) {
    case FrameSource::cotangents: return kVertexEntry;
    case FrameSource::tangents: return kTangentEntry;
    case FrameSource::triangle: return kEdgeEntry;
    case FrameSource::differences: break;
    }
    return kEntry;
}

std::string entryOf(const Choice& choice)
{
    if (isGodotShader(choice) && readsTriangleVectors(choice.frame))
        return "cotan_perturb_normal_on_triangle";
    switch (choice.stage) {
    case Stage::fragment: return "cotan_perturb_normal_on_triangle";
    case Stage::vertex:
    case Stage::mesh: return "cotan_make_triangle";
    case Stage::compute:
    case Stage::all: break;
    }
    return entryOf(choice.frame);
}

bool hasSubstitute(const Choice& choice, Form form)
{
    return choice.language == Language::godot && !choice.callerDifferences
        && (readsVertices(choice.frame) || (readsTriangleVectors(choice.frame) && form == Form::fused));
}

Frame substituteOf(Frame frame) { return readsTangents(frame) ? Frame::orthonormal : Frame::cotangent; }

bool hasScreenEntry(const Choice& choice)
{
    return !choice.callerDifferences && choice.language != Language::cpp
        && info(choice.frame).source == FrameSource::differences;
}

std::string entryText(const Choice& choice, Form form)
{
    const bool godot = choice.language == Language::godot;
    if (readsVertices(choice.frame) || (readsTriangleVectors(choice.frame) && form == Form::fused)) {
        std::string text = readsVertices(choice.frame) ? fromVertices(choice.frame, form) : ofTriangle(choice);
        if (godot && readsCotangents(choice.frame))
            text = std::string(kSmoothInView) + "\n" + text;
        return hasSubstitute(choice, form) ? text + orFromScreen(choice) : text;
    }
    std::string text =
        choice.uvSets == 1 ? fromDifferences(choice.frame, form) : fromSeveralSets(choice.frame, form, choice.uvSets);
    if (hasScreenEntry(choice))
        text += fromScreen(choice.uvSets, form);
    if (hasScreenEntry(choice) && godot)
        text += kDirectionOfU;
    return text;
}

} // namespace cotan::shader_text
