// Shared by `render` and `compare`: loading the model and opening the renderer by PictureOptions (src/picture).
#pragma once

#include "common.hpp"
#include "cotan/picture.hpp"
#include "loading.hpp"

namespace cotan::app {

// openPicture and openPictureRenderer with a progress line; warnings are printed, errors have option names.
Result<Picture> loadPicture(const PictureOptions& options, const CommonOptions& common,
                            std::initializer_list<FrameChoice> frames);
Result<std::unique_ptr<Renderer>> makePictureRenderer(const PictureOptions& options, const CommonOptions& common,
                                                      Picture& picture);

// Sizes and counts for a report.
Json describeScene(const PictureOptions& options, const Picture& picture);

} // namespace cotan::app
