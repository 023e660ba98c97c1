// Draws orders one by one, and caches what they share: devices, scenes, the environment, the ground.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cotan/picture.hpp"
#include "render_thread.hpp"

namespace cotan::viewer {

// A value cached for one key.
template<class T> struct Kept {
    std::string key;
    std::optional<T> value;
};

// A scene with the maps and attributes of one side, loaded on a device.
struct CachedScene {
    std::string key;
    std::shared_ptr<const Model> model; // owns what `scene` points to if no copy was needed
    Scene own;
    const Scene* scene = nullptr;
    std::unique_ptr<Renderer> renderer;
    Kept<std::shared_ptr<const GroundMap>> ground;
    Kept<std::vector<SurfaceEdge>> edges;
};

// Used by one thread only.
class SceneCache {
public:
    explicit SceneCache(app::CommonOptions common) : common_(std::move(common)) {}

    // Opens the environment. Errors are ignored, because they occur again, and are reported, on use.
    void openEnvironment(const PictureOptions& o);
    // The device of the window, which draws the images for it; null: renderers open their own.
    void drawOn(std::shared_ptr<Device> device) { device_ = std::move(device); }
    Drawn draw(const Order& order);
    // Adds degrees and statistics to a result.
    Status drawFigures(const Order& order, Drawn& drawn);
    // floats: for a file with float values.
    Result<Image> drawForFile(const Order& order, bool floats);

private:
    enum class Aim { window, file, floatFile };
    Status drawInto(const Order& order, Drawn& drawn, Aim aim);
    Result<Drawing> drawSide(CachedScene& s, const View& view, const PictureOptions& o, Aim aim);
    Result<std::unique_ptr<Renderer>> openRenderer(const PictureOptions& o) const;
    Status layEdgesOn(CachedScene& s, const View& view, const PictureOptions& o, Image& image);
    // Angles between the normals of the first image and those of the same scene with the frame `meant`, or of the
    // second image.
    Result<std::vector<float>> degreesOf(const Order& order, CachedScene& first, const View& view,
                                         const std::optional<Frame>& meant);
    // The scene of a side on a renderer. The second side has its own renderer only if its scene differs. normals: for
    // drawing normals, so without inspection colours.
    Result<CachedScene*> cachedScene(std::size_t index, const Order& order, bool second, bool normals = false);
    // The view as in `cotan render`. exposure: for "auto"; 0: meter it.
    Result<View> viewFor(const Order& order, CachedScene& s, bool second, float exposure);

    app::CommonOptions common_;
    std::shared_ptr<Device> device_;
    std::array<CachedScene, 2> cachedScenes_;
    Kept<std::shared_ptr<const EnvironmentMap>> environment_;
    double seconds_ = 0; // drawing time of the last image that is no draft
};

} // namespace cotan::viewer
