// Draws orders, one after another, and keeps what several of them need: devices, scenes, surroundings, the ground.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "artist.hpp"
#include "cotan/picture.hpp"

namespace cotan::viewer {

// Keeps what was made for a key, until another one is asked for.
template<class T> struct Kept {
    std::string key;
    std::optional<T> value;
};

// A scene with the maps and the attributes of one side, on a device.
struct Stage {
    std::string key;
    std::shared_ptr<const Model> model; // what `scene` points to, where nothing had to be made
    Scene own;
    const Scene* scene = nullptr;
    std::unique_ptr<Painter> painter;
};

// Touched by one thread alone.
class Studio {
public:
    Studio(app::CommonOptions common, bool validation) : common_(std::move(common)), validation_(validation) {}

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
    Result<Image> drawSide(const Order& order, Stage& s, const View& view, const PictureOptions& o, bool floats);
    Status layEdgesOn(const Order& order, Stage& s, const View& view, const PictureOptions& o, Image& picture);
    // Between the normals of the first picture and those of the second, or those of the frame `exact`.
    Result<std::vector<float>> degreesOf(const Order& order, Stage& first, const View& view,
                                         const PictureOptions& second, bool two);
    // The scene of a side on a painter; the second has a painter of its own only where its scene is another.
    // normals: not in the colours that are shown, but as a surface.
    Result<Stage*> stage(std::size_t index, const Order& order, bool second, bool normals = false);
    // As `cotan render` makes it. exposure: for "auto"; 0: found by metering.
    Result<View> viewFor(const Order& order, Stage& s, bool second, float exposure);

    app::CommonOptions common_;
    bool validation_ = false;
    std::array<Stage, 2> stages_;
    Kept<std::shared_ptr<const EnvironmentMap>> surroundings_;
    Kept<std::shared_ptr<const GroundMap>> ground_;
    Kept<std::vector<SurfaceEdge>> edges_;
    double seconds_ = 0; // of the last whole picture
};

} // namespace cotan::viewer
