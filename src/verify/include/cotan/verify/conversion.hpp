// Whether a model that was made for another frame looks like the original: both drawn from several sides with
// their own frames, and the normals compared.
#pragma once

#include <vector>

#include "cotan/draw/painter.hpp"
#include "cotan/frame.hpp"
#include "cotan/scene/view.hpp"
#include "cotan/surface/vertex_frames.hpp"
#include "cotan/verify/compared_views.hpp"

namespace cotan {

inline constexpr int kConversionViews = 5;  // from the front, turned by quarters, and from above
inline constexpr int kConversionSide = 768; // pixels

// A model and the frame that its maps are for.
struct ModelInFrame {
    Scene scene;
    Frame frame = Frame::cotangent;
    TangentOrigin tangents = TangentOrigin::stored; // that are drawn with
};

// The normals of one model, one picture a camera: square, float32, alpha 1 where there is surface.
struct DrawnSides {
    std::vector<Camera> cameras;
    std::vector<Image> normals;
    bool mapped = false; // something that is drawn reads a normal map
};

// Draws both models with the cameras of the first and compares. side: of a picture, in pixels.
// The painter has no scene afterwards. It reports each picture to painter.progress: kConversionViews of the
// one model, then as many of the other.
// Errors: those of Painter::load and Painter::draw.
Result<ComparedViews> verifyConversion(Painter& painter, ModelInFrame before, ModelInFrame after,
                                       int side = kConversionSide);

// The two steps of it, for callers who do not want to hold both models at once.
//
// Draws a model's normals. cameras: empty for kConversionViews around the model. Errors: as above.
Result<DrawnSides> drawSides(Painter& painter, ModelInFrame model, std::vector<Camera> cameras = {},
                             int side = kConversionSide);
// Compares what drawSides has drawn with the same cameras; `after` counts as drawn, `before` as expected.
// Errors: ErrorKind::usage for pictures of another number or size.
Result<ComparedViews> compareSides(const DrawnSides& before, const DrawnSides& after);

} // namespace cotan
