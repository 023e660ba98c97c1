// Draws orders, one after another, and keeps what several of them need: devices, scenes, the environment, the ground.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cotan/picture.hpp"
#include "render_thread.hpp"

namespace cotan::viewer {

// Keeps what was made for a key, until another one is asked for.
template<class T> struct Kept {
    std::string key;
    std::optional<T> value;
};

// A scene with the maps and the attributes of one side, on a device.
struct CachedScene {
    std::string key;
    std::shared_ptr<const Model> model; // what `scene` points to, where nothing had to be made
    Scene own;
    const Scene* scene = nullptr;
    std::unique_ptr<Renderer> renderer;
};

// Touched by one thread alone.
class SceneCache {
public:
    SceneCache(app::CommonOptions common, bool validation) : common_(std::move(common)), validation_(validation) {}

    // What can be had before there is a model. What fails fails again, and is said, when it is needed.
    void open(const PictureOptions& o);
    Drawn draw(const Order& order);
    // Adds degrees and statistics to what was drawn.
    Status drawFigures(const Order& order, Drawn& drawn);
    // floats: as for a file that keeps them.
    Result<Image> drawForFile(const Order& order, bool floats);
    // Of the validation layer, on all devices.
    std::vector<std::string> messages() const;

private:
    Status drawInto(const Order& order, Drawn& drawn, bool floats);
    Result<Image> drawSide(const Order& order, CachedScene& s, const View& view, const PictureOptions& o, bool floats);
    Status layEdgesOn(const Order& order, CachedScene& s, const View& view, const PictureOptions& o, Image& picture);
    // Between the normals of the first picture and those of the second, or those of the frame `exact`.
    Result<std::vector<float>> degreesOf(const Order& order, CachedScene& first, const View& view,
                                         const PictureOptions& second, bool two);
    // The scene of a side on a renderer; the second has a renderer of its own only where its scene is another.
    // normals: not in the colours that are shown, but as a surface.
    Result<CachedScene*> cachedScene(std::size_t index, const Order& order, bool second, bool normals = false);
    // As `cotan render` makes it. exposure: for "auto"; 0: found by metering.
    Result<View> viewFor(const Order& order, CachedScene& s, bool second, float exposure);

    app::CommonOptions common_;
    bool validation_ = false;
    std::array<CachedScene, 2> cachedScenes_;
    Kept<std::shared_ptr<const EnvironmentMap>> environment_;
    Kept<std::shared_ptr<const GroundMap>> ground_;
    Kept<std::vector<SurfaceEdge>> edges_;
    double seconds_ = 0; // of the last whole picture
};

} // namespace cotan::viewer
