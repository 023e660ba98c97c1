// What `render` and `compare` share: the words that say which model, seen how, drawn by what (src/picture).
#pragma once

#include "common.hpp"
#include "cotan/picture.hpp"
#include "loading.hpp"

namespace cotan::app {

// The same of the part, under a line of progress; warnings are printed, errors are in words.
Result<Picture> loadPicture(const PictureOptions& options, const CommonOptions& common,
                            std::initializer_list<FrameChoice> frames, const View* like = nullptr);
Result<std::unique_ptr<Renderer>> makePictureRenderer(const PictureOptions& options, const CommonOptions& common,
                                                      Picture& picture);

// Sizes and counts for a report.
Json describeScene(const PictureOptions& options, const Picture& picture);

} // namespace cotan::app
