// The light that perturbed normals lose, and the two-facet model that loses none.
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "cotan/portable.hpp"
#include "cotan/view.hpp"
#include "figure.hpp"
#include "stage.hpp"

namespace cotan::figures {

namespace {

constexpr float kGrey = 0.5f;   // linear brightness at which the furnace is displayed
constexpr int kMaxPixels = 360; // maximum image side: each pixel takes 64 slow random walks

Scene ballScene(Material material)
{
    Mesh mesh = makeSphere(1, 64);
    scaleTexcoords(mesh, 6, 3);
    Scene scene = sceneOf(std::move(mesh), makeReliefMap(Relief::domes, 256), material);
    scene.materials[0].normalScale = 1.5f;
    return scene;
}

View ballView(const FigureRenderer& studio, NormalMapping mapping)
{
    View view = squareView(studio, frontal(2.2f));
    view.width = view.height = std::min(view.height, kMaxPixels);
    view.frame = Frame::cotangent;
    view.shading = Shading::pbr;
    view.normalMapping = mapping;
    view.samples = 1;
    return view;
}

// Encodes linear values as sRGB without tone mapping.
Image toDisplay(const Image& linear)
{
    Image image = makeImage(linear.width, linear.height, PixelType::unorm8);
    for (std::size_t i = 0; i < image.data.size(); ++i) {
        const float x = f32::cotan_saturate(linear.floats()[i]);
        image.bytes8()[i] = std::uint8_t(std::lround(255 * (i % 4 == 3 ? x : f32::cotan_linear_to_srgb(x))));
    }
    return image;
}

// Fraction of the furnace's light that is lost where `normals` has a surface.
double lostFraction(const Image& linear, const Image& normals)
{
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < linear.pixelCount(); ++i)
        if (normals.floats()[4 * i + 3] > 0) {
            sum += 1 - double(linear.floats()[4 * i + 1]) / double(kGrey);
            ++count;
        }
    return sum / std::max(count, 1.0);
}

constexpr struct {
    NormalMapping mapping;
    const char *file, *label, *caption;
} kModes[] = {
    {NormalMapping::rays, "rays", "classic, with rays", "Rays that leave below the surface are lost."},
    {NormalMapping::shadowed, "shadowed", "classic, shadowed", "Less grazing light, so that no edge shows."},
    {NormalMapping::mirrorFacet, "mirror-facet", "two facets, the second a mirror", "The paper's own choice."},
    {NormalMapping::facets, "facets", "two facets of one material", "All bounces between them."}};

void addFurnace(FigureRenderer& studio, Figure& figure)
{
    const auto white =
        std::make_shared<const EnvironmentMap>(makeEnvironment([](glm::vec3) { return glm::vec3(1); }, 1));
    const Scene scene = ballScene(dielectric(glm::vec3(1), 0.5f));
    studio.show(scene);
    for (const auto& mode : kModes) {
        View view = ballView(studio, mode.mapping);
        view.lights.clear();
        view.environmentMap = white;
        view.backdrop = Backdrop::sharp;
        view.linearOutput = true;
        view.exposure = kGrey;
        const Image linear = studio.drawReference(view);
        view.output = Output::normal;
        const double fraction = lostFraction(linear, studio.drawReference(view));
        figure.panels.push_back({std::string("furnace-") + mode.file, std::string(mode.label) + ", white furnace",
                                 fmt::format("{} Lost: {:.1f} %.", mode.caption, 100 * fraction), toDisplay(linear)});
        figure.numbers.push_back({std::string(mode.file) + ", light lost in a white furnace, %", 100 * fraction});
    }
}

void addLit(FigureRenderer& studio, Figure& figure)
{
    const Scene scene = ballScene(metal({0.95f, 0.72f, 0.45f}, 0.35f));
    studio.show(scene);
    figure.panels.push_back({"lit-shading", "classic, as shaded", "Lights and the environment meet the normal.",
                             studio.drawReference(ballView(studio, NormalMapping::shading))});
    for (const auto& mode : kModes)
        figure.panels.push_back({std::string("lit-") + mode.file, mode.label, mode.caption,
                                 studio.drawReference(ballView(studio, mode.mapping))});
}

} // namespace

Figure makeFurnaceFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Light lost by perturbed normals";
    figure.text = {
        "A white ball in uniform light: where no light is lost, the ball is invisible. A perturbed normal "
        "reflects some rays below the surface, where there is no light, most of all at the rim. V. Schuessler "
        "and "
        "others (2017) replace it by two facets: one along the map's normal and one upright that compensates, so that "
        "their mean is the normal of the surface. A ray bounces between them until it leaves.",
        "Below, a rough metal under a lamp and a sky. Facets are a surface, not a perturbed normal: they look softer "
        "at the rim. All by the reference renderer."};
    addFurnace(studio, figure);
    addLit(studio, figure);
    figure.sliders = {{0, 3}, {4, 8}};
    figure.overview = {0, 3};
    return figure;
}

} // namespace cotan::figures
