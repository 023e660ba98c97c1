#include "core/named_values.hpp"
#include "entry.hpp"
#include "languages.hpp"

namespace cotan::shader_text {

namespace {

// In the order of Channels, Expansion and Form.
constexpr std::string_view kChannelTexts[] = {"three channels", "two channels, z = sqrt(1 - x^2 - y^2)",
                                              "two channels, (x, y)/(1 + z)", "two channels, slopes"};
constexpr std::string_view kExpansionTexts[] = {"(255c - 128)/127", "2c - 1", "signed values as sampled",
                                                "(65535c - 32768)/32767"};
constexpr std::string_view kFormTexts[] = {"fused", "total form", "fused, normal facing the viewer",
                                           "fused, for square texels", ""};

std::string call(const Choice& choice, Form form)
{
    const LanguageInfo& language = infoOf(choice.language);
    const std::string type =
        language.grammar.typesAfterNames ? "let" : std::string(language.scope) + wordOf(choice.language, "cotan_vec3");
    // arguments: those before the sampled texel.
    const auto calling = [&](std::string_view function, std::string_view arguments, std::string_view behind = "") {
        return fill("{} n = {}{}({}, {}{});", type, language.scope, function, arguments, language.sample, behind);
    };
    const bool godotOrScreen = hasSubstitute(choice, form);
    if (readsVertices(choice.frame) && godotOrScreen)
        return calling(kScreenEntry,
                       readsCotangents(choice.frame) ? "normal, position, uv, cotangent, cobitangent"
                                                     : "normal, position, uv, tangent, w");
    if (readsVertices(choice.frame))
        return calling(entryOf(choice.frame),
                       readsCotangents(choice.frame) ? "normal, cotangent, cobitangent"
                                                     : "normal, tangent.xyz, tangent.w");
    const bool vectors = readsTriangleVectors(choice.frame) && form == Form::fused;
    if (godotOrScreen)
        return calling(kScreenEntry, "normal, position, uv, u, v");
    if (vectors && choice.language == Language::godot)
        return calling("cotan_perturb_normal_on_triangle", "normal, u, v");
    if (vectors && choice.stage != Stage::compute) {
        const std::string make =
            fill("words = {}cotan_make_triangle(p0, p1, p2, uv0, uv1, uv2, n0, n1, n2);", language.scope);
        const std::string pixel = calling("cotan_perturb_normal_on_triangle", "normal, words");
        return choice.stage == Stage::fragment ? pixel
            : choice.stage == Stage::all       ? make + "   (vertex or mesh stage)\n//   " + pixel + "   (pixels)"
                                               : make;
    }
    if (info(choice.frame).source == FrameSource::triangle)
        return calling(kEdgeEntry, "normal, p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0");
    const bool screen = hasScreenEntry(choice);
    const char* const entry = screen ? kScreenEntry : kEntry;
    std::string arguments = screen ? "normal, position" : "normal, dpdx, dpdy";
    if (choice.uvSets == 1)
        return calling(entry, arguments + (screen ? ", uv" : ", duvdx, duvdy"), form == Form::seen ? ", side" : "");
    for (int k = 0; k < choice.uvSets; ++k)
        arguments += fill(screen ? ", uv{0}, texel{0}" : ", duv{0}dx, duv{0}dy, texel{0}", k);
    return fill("{} n = {}{}({});", type, language.scope, entry, arguments);
}

std::string needs(const Choice& choice, Form form)
{
    if (choice.language == Language::godot)
        return godotNeeds(choice, form);
    std::string text = "// Needs from the caller:\n";
    if (choice.stage == Stage::vertex)
        return text
            + fill("//   the corners of the triangle that this vertex provokes: its own position, uv and normal, "
                   "and those\n"
                   "//   of the other two, read from {}. Pass the three words on without interpolation (flat).\n"
                   "//   An index buffer in which every triangle owns its provoking vertex, the first (in OpenGL and "
                   "WebGL\n"
                   "//   the last): cotan convert --provoking, or provokingMesh of cotan/gpu_meshes.hpp.\n",
                   infoOf(choice.language).cornersIn);
    if (choice.stage == Stage::mesh)
        return text + "//   the corners of the primitive. Pass the three words on per primitive.\n";
    if (choice.stage == Stage::fragment)
        return text
            + "//   normal     interpolated surface normal, in the space that the triangle was made in\n"
              "//   words      from the stage before, not interpolated (flat, or for each primitive), or read from a\n"
              "//              buffer by the number of the triangle\n"
              "//\n// Missing:\n"
              "//   Words of 0 give the normal without bumps, other words that were not made here wrong bumps. Draw\n"
              "//   a mesh without them with the text of `cotangent`.\n";
    text += "//   normal     interpolated surface normal; any space, the same for all vectors\n";
    if (readsVertices(choice.frame))
        return text
            + fill("//   the vertex attributes named at the function below, interpolated\n"
                   "//\n// Missing:\n"
                   "//   Most programs fill in zeros or a constant for a mesh without these attributes. Zeros give "
                   "the\n"
                   "//   normal without bumps, a constant gives wrong bumps. Draw such a mesh with the text of `{}`.\n",
                   name(substituteOf(choice.frame)));
    if (readsTriangleVectors(choice.frame) && choice.stage == Stage::all)
        return text
            + "//   p0 p1 p2, uv0 uv1 uv2, n0 n1 n2  the triangle's corners, in the vertex stage (at the provoking\n"
              "//              vertex), the mesh stage, or in one stage with all the rest; no screen derivatives\n";
    if (info(choice.frame).source == FrameSource::triangle)
        return text + "//   p0 p1 p2, uv0 uv1 uv2  the triangle's corners; no screen derivatives\n";
    text += "//   position   camera-relative (world axes, origin at the eye), interpolated, NOT normalised;\n"
            "//              normalising it first gives an error of 11 degrees at a grazing angle of 45 degrees\n"
            "//   uv         those of the normal map\n";
    if (hasScreenEntry(choice))
        return text
            + fill("//   derivatives of position and uv: taken here by {} and {}. Interpolate both alike, not\n"
                   "//              at centroids; call it before any discard, if or loop that differs between pixels\n",
                   wordOf(choice.language, "cotan_ddx"), wordOf(choice.language, "cotan_ddy"));
    return text
        + "//   derivatives of position and uv: passed in, along any two directions, the same for both\n"
          "//              (screen derivatives, ray differentials, neighbours in a raster)\n";
}

std::string_view sidesOf(Frame frame)
{
    const FrameInfo& f = info(frame);
    if (f.source != FrameSource::differences || !f.total || f.dependsOnView)
        return "";
    return "//   Right for y-up and y-down targets, both handednesses, mirrored uv and transforms, and back\n"
           "//   faces, with no uniform and no front-face flag.\n";
}

std::string limits(const Choice& choice, Form form)
{
    std::string text = "// Limits:\n";
    if (form == Form::fused && readsTriangleVectors(choice.frame))
        text +=
            "//   No NaN for constant uv, zero edges or empty texels: the result is then the interpolated normal.\n"
            "//   Undefined for non-finite input and normals shorter than 0.01. Matches the frame to 0.03 degrees,\n"
            "//   the error of half floats, for (longest edge) * (longest uv difference) within 1e-12 .. 1e5, each\n"
            "//   within 1e-9 .. 1e6, and triangles that are not slivers (area a tenth of the longest edge squared).\n"
            "//   Slopes are those of `cotangent` times a factor between cos(a) and 1, where the normal is at an\n"
            "//   angle a to the triangle's own.\n";
    else if (form == Form::fused && readsVertices(choice.frame))
        text += "//   No NaN for empty texels or covectors of zero: the result is then the interpolated normal.\n"
                "//   Undefined for non-finite input and normals shorter than 0.01.\n";
    else if (form == Form::seen)
        text +=
            "//   Matches the frame to 0.01 degrees, with the scale of `triangle`: slopes are those of `cotangent`\n"
            "//   times a factor between cos(a) and 1, where the normal is at an angle a to the surface's. No NaN for\n"
            "//   constant uv, zero differences or empty texels. Undefined for non-finite input and normals shorter\n"
            "//   than 0.01. Right for mirrored uv and transforms. The caller flips the normal on back faces and\n"
            "//   passes `side`.\n";
    else if (form == Form::area)
        text += "//   As `cotangent` where texels are square on the surface. On uv stretched a:1 slopes are sqrt(a)\n"
                "//   times as steep, on uv sheared by an angle s 1/cos(s) times. Undefined for non-finite input and\n"
                "//   normals shorter than 0.01.\n";
    else if (form == Form::fused)
        text += "//   No NaN for constant uv, zero differences, footprints without area or empty texels: the\n"
                "//   result is then the interpolated normal, or as the function says. Undefined for\n"
                "//   non-finite input and normals shorter than 0.01. Matches the frame to 0.01 degrees for (longest\n"
                "//   position difference) * (longest uv difference) within 1e-12 .. 1e5, each within\n"
                "//   1e-9 .. 1e6, and footprints that are not slivers (area a tenth of the longest squared).\n";
    else if (info(choice.frame).normal == FrameNormal::nobody)
        text += "//   Zero vectors and non-finite ones give the interpolated normal unchanged.\n";
    else if (info(choice.frame).total)
        text += "//   Total: no input gives NaN; where there is no frame (constant uv, no area, non-finite\n"
                "//   differences) the result is the unit interpolated normal.\n";
    else
        text += "//   Not total: degenerate input can give NaN, see the function.\n";
    if (form != Form::seen)
        text += sidesOf(choice.frame);
    if (info(choice.frame).source == FrameSource::differences)
        text += "//   In float, the error is 0.002 degrees for footprints of 1e-3 of the distance to the eye, and\n"
                "//   0.12 degrees for 1e-5.\n"
                "//   On flat-shaded uv the frame is constant per triangle: on coarse curved meshes it steps at\n"
                "//   edges"
            + std::string(choice.frame == Frame::cotangent ? " (a sphere of 32 segments: 1.1 degrees in the mean).\n"
                                                           : ".\n");
    return text + std::string(infoOf(choice.language).limits);
}

// Returns the remarks on the parts of the sets that the caller implements.
std::string ofSets(const Choice& choice)
{
    std::string text;
    if (hasSet(choice, Set::environment))
        text +=
            "//   environment  one image of square tiles, 970 x 524 texels of linear light, read by the caller with\n"
            "//              bilinear filtering and no mips at cotan_environment_texel. Tiles 0 to 8 hold\n"
            "//              radiance filtered for roughness 0, 1/8, ... 1; 9 irradiance over pi; 10 how much white\n"
            "//              light GGX reflects (x times f0, plus y). World space, y up\n";
    if (hasSet(choice, Set::tone))
        text += "//   tone       linear colours with the primaries of sRGB, not negative, to linear in [0,1]; curve 0 "
                "cuts\n"
                "//              off, 1 is ACES, 2 Khronos PBR Neutral, 3 AgX\n";
    if (hasSet(choice, Set::shadow))
        text += "//   shadow     you read the shadow map: about 8 reads around the point for the mean depth of the\n"
                "//              blockers, then about 24 comparisons in the disc of cotan_penumbra\n";
    return text.empty() ? text : "// Sets:\n" + text + "//\n";
}

std::string credits(const Choice& choice)
{
    std::string text = "// After:\n"
                       "//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006\n"
                       "//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013\n";
    const std::string_view ofGradients = info(Frame::gradient).after, ofFrame = info(choice.frame).after;
    const bool gradients = hasSet(choice, Set::gradient) || choice.uvSets > 1;
    if (gradients)
        text += fill("//   {}\n", ofGradients);
    if (!ofFrame.empty() && !(gradients && ofFrame == ofGradients))
        text += fill("//   {}\n", ofFrame);
    if (hasSet(choice, Set::shadow))
        text += "//   R. Fernando, Percentage-Closer Soft Shadows, 2005\n";
    if (hasSet(choice, Set::blend))
        text += "//   [2012] C. Barre-Brisebois, S. Hill, Blending in Detail, 2012\n";
    return text;
}

} // namespace

std::string introduction(const Choice& choice, Form form)
{
    const Convention& c = choice.convention;
    const LanguageInfo& language = infoOf(choice.language);
    const bool halfs = readsTriangleVectors(choice.frame) && form == Form::fused && !language.titleWithHalfs.empty();
    return fill("// Normal mapping, frame `{}` ({}), for {}.\n"
                "// Written by cotan shader from the portable text of Cotan; MIT licence.\n"
                "//\n"
                "// Normal map: {}, {}, green {} increasing v.\n"
                "//\n{}//\n// Call:\n//   {}\n// It returns {}.\n//\n{}//\n{}{}\n",
                name(choice.frame), textAt(kFormTexts, form), halfs ? language.titleWithHalfs : language.title,
                textAt(kChannelTexts, c.channels), textAt(kExpansionTexts, c.expansion, 2),
                greenAlongV(c) ? "along" : "against", needs(choice, form), call(choice, form),
                choice.stage == Stage::vertex || choice.stage == Stage::mesh
                    ? "three words, the same for the whole triangle"
                    : "the perturbed normal, unit, in the space of the arguments",
                limits(choice, form), ofSets(choice), credits(choice));
}

} // namespace cotan::shader_text
