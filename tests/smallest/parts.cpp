// Uses the parts that need only GLM together. Returns the number of facts that do not hold.
#include <cmath>
#include <cstdio>
#include <string>

#include <cotan/maps.hpp>
#include <cotan/render.hpp>
#include <cotan/scene.hpp>
#include <cotan/shader_text.hpp>

namespace {

int failures = 0;

void expect(bool fact, const char* what)
{
    if (!fact)
        std::printf("does not hold: %s\n", what);
    failures += !fact;
}

} // namespace

int main()
{
    using namespace cotan;
    const auto shader =
        shader_text::makeShaderText({.language = shader_text::Language::hlsl, .frame = Frame::cotangent});
    expect(shader && shader->text.find("cotan_perturb") != std::string::npos, "a shader's text");

    const Image map = makeReliefMap(Relief::waves, 128);
    expect(maps::greenOf(map).green == maps::Green::up, "green of our map points up");
    maps::RecodeSettings settings;
    settings.to.greenUp = false;
    maps::RecodeCounts counts;
    expect(maps::greenOf(maps::recode(map, settings, counts)).green == maps::Green::down, "reversed, it points down");

    const Scene scene = builtinScene();
    View view;
    view.width = view.height = 32;
    view.camera = frontCamera(scene, view.width, view.height);
    view.output = Output::normal;
    const auto image = drawView(scene, view, "auto");
    bool unit = bool(image), seen = false;
    for (std::size_t i = 0; unit && i < image->pixelCount(); ++i) {
        const float* p = image->floats() + 4 * i;
        seen |= p[3] == 1;
        unit = p[3] != 1 || std::abs(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1) < 1e-4f; // up to rounding in float
    }
    expect(unit && seen, "an image of unit normals");

    const auto device = drawView(scene, view, "llvmpipe");
    expect(!device && device.error().kind == ErrorKind::unavailable
               && device.error().message.starts_with("not built with Vulkan: install libvulkan-dev"),
           "a device that is asked for by name is refused");
    std::printf("%d facts of the parts do not hold\n", failures);
    return failures;
}
