// Pictures one after another in one file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "cotan/result.hpp"
#include "cotan/scene/image.hpp"

namespace cotan {

struct AnimationFormat {
    int width = 0, height = 0;
    std::size_t pictures = 1;
    double rate = 24; // pictures a second
};

// The file appears with finish(), whole; without it nothing does.
class AnimationWriter {
public:
    virtual ~AnimationWriter() = default;
    // The next picture, of that size; float32 is clamped to [0,1]. Errors: ErrorKind::output.
    virtual Status add(const Image& picture) = 0;
    // After the last one. Errors: ErrorKind::output.
    virtual Status finish() = 0;
};

// Whether a file of that name holds many pictures: .webp, .gif.
bool isAnimation(const std::filesystem::path& file);

// The rate that the file will have: GIF counts in hundredths of a second.
double animationRate(const std::filesystem::path& file, double rate);

// WebP of quality 90 with alpha, each picture shown from its time to that of the next, in milliseconds; GIF of 256
// colours a picture and no alpha. Both repeat for ever.
// Errors: ErrorKind::usage for a side of over 16383 pixels (GIF 65535), over 50 pictures a second in a GIF, which
// viewers slow down, or 1000 in WebP; ErrorKind::unavailable where this build lacks the library; those of
// OutputFile::begin.
Result<std::unique_ptr<AnimationWriter>> createAnimation(const std::filesystem::path& file,
                                                         const AnimationFormat& format);

} // namespace cotan
