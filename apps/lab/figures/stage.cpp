#include "stage.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/view.hpp"

namespace cotan::figures {

Scene sceneOf(Mesh mesh, Image map, Material material)
{
    Scene scene;
    scene.name = mesh.name;
    scene.images.push_back(std::move(map));
    material.normalMap.image = 0;
    material.normalMap.sampler.mip = MipFilter::none;
    scene.materials.push_back(std::move(material));
    mesh.material = 0;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({"", 0, glm::mat4(1)});
    return scene;
}

Material dielectric(glm::vec3 linearColor, float roughness)
{
    Material material;
    material.baseColor = glm::vec4(linearColor, 1);
    material.metallic = 0;
    material.roughness = roughness;
    return material;
}

Material metal(glm::vec3 linearColor, float roughness)
{
    Material material = dielectric(linearColor, roughness);
    material.metallic = 1;
    return material;
}

Scene withVertexFrames(Scene scene, Frame frame)
{
    deriveVertexFrames(scene, frame, TangentOrigin::generated);
    return scene;
}

void scaleTexcoords(Mesh& mesh, float u, float v)
{
    for (glm::vec2& uv : mesh.texcoords[0])
        uv *= glm::vec2(u, v);
}

Light upperLeft()
{
    Light light;
    light.direction = glm::normalize(glm::vec3(0.62f, -0.62f, -0.55f));
    light.intensity = 3.2f;
    return light;
}

Light behindLeft()
{
    Light light = upperLeft();
    light.direction = glm::normalize(glm::vec3(0.6f, -0.62f, 0.5f));
    return light;
}

Camera frontal(float extent)
{
    Camera camera;
    camera.orthographic = true;
    camera.verticalExtent = extent;
    camera.eye = {0, 0, 5};
    return camera;
}

View wideView(const FigureRenderer& studio, const Camera& camera)
{
    View view;
    view.width = studio.width();
    view.height = studio.height();
    view.camera = camera;
    view.shading = Shading::blinnPhong;
    view.lights = {upperLeft()};
    view.shadows = false;
    view.exposure = 0.8f;
    return view;
}

View squareView(const FigureRenderer& studio, const Camera& camera)
{
    View view = wideView(studio, camera);
    view.width = view.height;
    return view;
}

void pasteInset(Image& image, const Image& inset)
{
    const int border = std::max(image.height / 160, 1);
    const int x0 = image.width - inset.width - border;
    const int y0 = image.height - inset.height - border;
    for (int y = -border; y < inset.height + border; ++y)
        for (int x = -border; x < inset.width + border; ++x) {
            const int px = x0 + x, py = y0 + y;
            if (px < 0 || py < 0 || px >= image.width || py >= image.height)
                continue;
            const bool inside = x >= 0 && y >= 0 && x < inset.width && y < inset.height;
            std::uint8_t* to = image.bytes8() + 4 * (std::ptrdiff_t(py) * image.width + px);
            for (int c = 0; c < 4; ++c)
                to[c] = inside ? inset.bytes8()[4 * (std::ptrdiff_t(y) * inset.width + x) + c] : 255;
        }
}

namespace {

// Mean of a box of pixels, in [0,255].
glm::vec4 boxMean(const Image& image, glm::dvec2 low, glm::dvec2 high)
{
    const int x0 = int(low.x), y0 = int(low.y);
    const int x1 = std::min(std::max(int(high.x), x0 + 1), image.width);
    const int y1 = std::min(std::max(int(high.y), y0 + 1), image.height);
    glm::vec4 sum(0);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            for (int c = 0; c < 4; ++c)
                sum[c] += image.bytes8()[4 * (std::ptrdiff_t(y) * image.width + x) + c];
    return sum / float((x1 - x0) * (y1 - y0));
}

// Shrinks an image into a rectangle of the sheet, centred, keeping its aspect ratio.
void pasteScaled(Image& sheet, const Image& image, int x0, int y0, int width, int height)
{
    const double scale = std::max(double(image.width) / width, double(image.height) / height);
    const int w = std::clamp(int(image.width / scale), 1, width);
    const int h = std::clamp(int(image.height / scale), 1, height);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const glm::vec4 mean = boxMean(image, glm::dvec2(x, y) * scale, glm::dvec2(x + 1, y + 1) * scale);
            const int px = x0 + (width - w) / 2 + x, py = y0 + (height - h) / 2 + y;
            std::uint8_t* to = sheet.bytes8() + 4 * (std::ptrdiff_t(py) * sheet.width + px);
            for (int c = 0; c < 3; ++c)
                to[c] = std::uint8_t(std::lround(mean[c]));
        }
}

} // namespace

Image contactSheet(const std::vector<const Image*>& images, int columns, int cellWidth, int cellHeight)
{
    constexpr int kGap = 6;
    const int count = int(images.size());
    const int rows = (count + columns - 1) / columns;
    Image sheet = makeImage(columns * (cellWidth + kGap) + kGap, rows * (cellHeight + kGap) + kGap, PixelType::unorm8,
                            "overview");
    std::fill_n(sheet.bytes8(), sheet.data.size(), std::uint8_t(40));
    for (std::size_t i = 0; i < sheet.pixelCount(); ++i)
        sheet.bytes8()[4 * i + 3] = 255;
    for (int i = 0; i < count; ++i)
        pasteScaled(sheet, *images[std::size_t(i)], kGap + i % columns * (cellWidth + kGap),
                    kGap + i / columns * (cellHeight + kGap), cellWidth, cellHeight);
    return sheet;
}

} // namespace cotan::figures
