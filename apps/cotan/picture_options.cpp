#include "picture_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/named_values.hpp"
#include "core/real_number.hpp"
#include "cotan/convention.hpp"

namespace cotan::app {

std::string usefulFrameNames()
{
    std::string names;
    for (const FrameInfo& f : frames())
        if (f.total)
            names += (names.empty() ? "" : ", ") + std::string(f.name);
    return names;
}

// "thumbnail (320x180), 720p (1280x720), ... or square (1024x1024)"
std::string sizePresetNames()
{
    std::vector<std::string> names = sizePresetWords();
    for (std::string& name : names)
        if (const auto size = parsePictureSize(name))
            name += fmt::format(" ({})", sizeWord(*size));
    return eitherOf(names);
}

std::string listOfFrames()
{
    std::string useful = "For use; no input gives NaN:\n",
                historical = "Historical forms, to compare with; some input gives NaN:\n";
    for (const FrameInfo& f : frames())
        (f.total ? useful : historical) += fmt::format("  {:<18}{}\n", f.name, f.summary);
    return useful + "\n" + historical;
}

void addListOfFrames(Arguments& a)
{
    a.group(HelpGroup::frame);
    a.answers("--list-frames", "list all frames with a line on each, historical ones too, and exit", listOfFrames);
}

void addMemoryOption(Arguments& a, int& memory, const std::string& also)
{
    a.option(
         "--memory", memory,
         "largest image to hold in memory" + also
             + ", in MiB; all images together may take 192 MiB (above 640: the given MiB) and 128 times the size of "
               "their files")
        .within(1, kMaxMemory)
        .in("MIB")
        .under(HelpGroup::general);
}

void addUpOption(Arguments& a, Up& up, const std::string& what)
{
    a.choice("--up", up, kUps,
             "axis of " + what
                 + " that points up: y; or z, as in PLY and STL of Blender and CAD, which rotates it by 90 degrees "
                   "about x")
        .under(HelpGroup::input);
}

void addTangentsOption(Arguments& a, TangentOrigin& tangents, const std::string& help)
{
    a.choice("--tangents", tangents, kTangentOrigins, help).under(HelpGroup::frame);
}

void addDeviceOption(Arguments& a, std::string& device, const std::string& use)
{
    a.option("--device", device, use + "auto, reference, or part of a Vulkan device's name")
        .in("DEVICE")
        .offers({"auto", "reference"})
        .under(HelpGroup::general);
}

namespace {

void addLightOptions(Arguments& a, PictureOptions& o)
{
    a.group(HelpGroup::light);
    a.option(
         "--exposure", o.exposure ? fmt::format("{}", *o.exposure) : kAutoExposure,
         [&o](const std::string& word) -> Status {
             o.exposure.reset();
             if (word != kAutoExposure)
                 o.exposure = float(*parseReal(word)); // above0Or has checked it
             return Done{};
         },
         "factor on all light, or auto: from the brightness of the model (1 in files that keep floats)")
        .above0Or(kAutoExposure)
        .in("X|auto")
        .offers({kAutoExposure});
    a.choice("--tone-mapping", o.toneMapping, kToneMappings,
             "curve from light to displayed colour: none (clamped to 1), neutral (Khronos PBR Neutral), aces "
             "(Narkowicz's) or agx; files that keep floats stay linear")
        .under(HelpGroup::look);
    a.option(
         "--environment", o.environment,
         "environment that lights the model: studio and evening (with a lamp and a sun, for models without lights), "
         "overcast, or a .hdr or .exr file in equirectangular projection; or none: a formula and a lamp")
        .in("NAME|FILE")
        .offers({"studio", "overcast", "evening", "none"})
        .reads();
    a.option("--environment-rotation", o.environmentRotation,
             "rotate the environment counter-clockwise, seen from above")
        .within(kRotations.minimum, kRotations.maximum)
        .in("DEGREES");
    a.option("--environment-intensity", o.environmentIntensity, "factor on the light of the environment")
        .above0()
        .in("X");
    a.choice("--background", o.background, kBackgrounds,
             "what is behind the model: paper (a photographer's; the default in the studio), blur (the environment out "
             "of focus; the default in others), environment, gradient (the default without one), or none (transparent)")
        .under(HelpGroup::look);
    a.choice("--ground", o.ground, kGrounds,
             "on: the model stands on level ground, which only shows its shadow; off: it floats");
    a.option("--shadow-softness", o.shadowSoftness,
             "angle that the shadow-casting light subtends: 0 for sharp edges, 0.5 for the sun (default: 10, in the "
             "evening 3)")
        .within(kSoftnesses.minimum, kSoftnesses.maximum)
        .in("DEGREES");
    a.flag("--no-shadows", o.noShadows, "draw no shadows of lights");
}

} // namespace

void addOwnNormalMap(Arguments& a, OwnMaps& maps)
{
    a.option("--normal-map", maps.normal, "image that replaces the model's normal maps, such as a new bake")
        .in("FILE")
        .reads()
        .under(HelpGroup::input);
    a.option("--convention", maps.convention,
             "how that image is stored (default: gltf) or, without one, how to decode the model's own normal maps "
             "(default: as the model says): "
                 + conventionWords())
        .in("WORDS")
        .offers(conventionWordList())
        .under(HelpGroup::input);
    a.option("--material", maps.material, "number of the material that gets this image; -1: all")
        .within(-1, kMaxMaterial)
        .in("N")
        .under(HelpGroup::input);
}

namespace {

void addOwnMaps(Arguments& a, OwnMaps& maps)
{
    addOwnNormalMap(a, maps);
    a.group(HelpGroup::input);
    a.option("--base-color", maps.baseColor, "image that replaces the model's colours, sRGB").in("FILE").reads();
    a.option("--metallic-roughness", maps.metallicRoughness,
             "image that replaces the model's roughness (green) and metallic (blue), as glTF has them")
        .in("FILE")
        .reads();
    a.option("--occlusion", maps.occlusion, "image that replaces the model's ambient occlusion (red)")
        .in("FILE")
        .reads();
}

} // namespace

void addFrameOption(Arguments& a, std::string& frame)
{
    std::vector<std::string> names = frameWords();
    names.insert(names.begin(), std::string(kAutoFrame));
    a.option(
         "--frame", frame,
         "frame to apply normal maps with: auto (for each part of a model the one that it names for its map, else the "
         "cheapest within --max-degrees, or its tangents; cotangent for shapes and repeated images), "
             + usefulFrameNames() + ", or a historical one of --list-frames")
        .in("NAME")
        .offers(names)
        .main();
    addListOfFrames(a);
}

void addMaxDegreesOption(Arguments& a, double& degrees)
{
    a.option(
         "--max-degrees", degrees,
         "error of normals, on average over a part of a model, that its frame may cause; ten times as much on 1 % of "
         "its area")
        .within(kChoiceDegrees.minimum, kChoiceDegrees.maximum)
        .in("D");
}

void addShowOption(Arguments& a, std::string& show)
{
    a.option(
         "--view", show,
         "what to draw: shaded; normal, tangent, bitangent, uv, depth; error (degrees from the frame exact); checker, "
         "density, stretch, shear, mirrored (uv and texels), w (of stored tangents), facing; or one map by itself: "
         "base-color, alpha, normal-map, normal-map-red, normal-map-green, normal-map-blue, roughness, metallic, "
         "occlusion, emissive")
        .from(showNames())
        .in("NAME")
        .main();
}

void addPictureOptions(Arguments& a, PictureOptions& o)
{
    a.group(HelpGroup::input);
    a.option("MODEL", o.model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file; the built-in scene if left out")
        .reads();
    a.choice("--shape", o.shape, kShapes, "without MODEL: shape to show maps on: plane, sphere, torus or teapot");
    addUpOption(a, o.up);
    addMemoryOption(a, o.memory);
    addOwnMaps(a, o.maps);
    a.option("--variant", o.variant,
             "variant of a glTF model's materials, by name or number; those of the file if left out")
        .in("NAME|N");
    a.option("--animation", o.animation,
             "animation of a glTF model, by name or number; the pose of the file if left out")
        .in("NAME|N");
    a.option("--time", o.time, "moment of --animation, in seconds from its start")
        .within(kMoments.minimum, kMoments.maximum)
        .in("S");
    addMaxDegreesOption(a, o.maxDegrees);
    a.group(HelpGroup::camera);
    a.option(
         "--size", sizeWord(o.size),
         [&o](const std::string& word) -> Status {
             const auto size = parsePictureSize(word);
             if (!size)
                 return size.error();
             o.size = *size;
             return Done{};
         },
         "width and height in pixels; 512 is 512x512; or " + sizePresetNames())
        .in("WxH")
        .offers(sizePresetWords())
        .main();
    a.option("--camera", o.camera,
             "where to look from: front (a little from the right and above), left, right, top, bottom, back, or "
             "orbit:AZ,EL "
             "(degrees around and above), each so near that the model fills the image; fit (farther: the whole "
             "bounding "
             "box); the number of a camera in the file; or eye and target \"ex,ey,ez,tx,ty,tz\" in world units, then "
             "\",DEGREES\" for a field of view other than 45 or \",hX\" for an orthographic view X units high, then "
             "\",ux,uy,uz\" for "
             "the up direction (default: front; the built-in scene's own)")
        .in("CAMERA")
        .offers({"front", "left", "right", "top", "bottom", "back", "fit"})
        .main();
    addDeviceOption(a, o.device);
    a.group(HelpGroup::diagnostics);
    a.choice("--edges", o.edges, kEdges,
             "lines over the image: none, triangles, seams (of uv: yellow; mirrored: magenta; borders: cyan) or all");
    a.choice("--shading", o.shading, kShadings, "shading model: pbr or blinn-phong").under(HelpGroup::look);
    a.choice("--lighting", o.lighting, kLightings,
             "space to light in: world; or tangent space, entered per vertex (tangent-vertex) or per pixel "
             "(tangent-pixel), for comparison and on the reference device only");
    a.choice("--normal-mapping", o.normalMapping, kNormalMappings,
             "how perturbed normals are used: shading; or with rays, on the reference device only: rays (light from "
             "below the surface is lost), shadowed, facets (a second facet compensates), mirror-facet");
    addTangentsOption(
        a, o.tangents,
        "for the frames vertex and mikktspace: stored (as in the file, generated where missing) or generated");
    a.choice("--samples", o.samples, kSampleCounts,
             "samples per pixel of the shaded image: 1; 4 for smooth edges; or 16, each shaded separately, for smooth "
             "highlights too, at the cost of 16 images")
        .in("N")
        .under(HelpGroup::look);
    addLightOptions(a, o);
    a.group(HelpGroup::diagnostics);
    a.choice("--rows", o.rowsUpward, kRows,
             "whether the rows of the render target run down or up; the image is upright either way");
    a.choice("--derivatives", o.derivatives, kDerivatives, "screen derivatives: fine or coarse");
    a.flag("--no-normal-maps", o.noNormalMaps, "use interpolated normals only");
    a.flag("--specular-antialiasing", o.specularAntialiasing,
           "light 16 to 256 normals per pixel, more for sharper highlights, each roughened by the detail below its "
           "spacing")
        .under(HelpGroup::look);
    a.flag("--point-sampled", o.pointSampled, "read the nearest texel of the finest level, for comparing devices");
}

} // namespace cotan::app
