// Pictures a few rows at a time, for those that memory does not hold.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "cotan/files/limits.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/image.hpp"

namespace cotan {

// The rows of a picture, from the top.
class RowReader {
public:
    virtual ~RowReader() = default;

    std::string name;          // for messages
    int width = 0, height = 0; // pixels
    PixelType type = PixelType::unorm8;
    bool alpha = false; // the file stores more than red, green and blue, or grey
    bool whole = false; // the picture is in memory already: its format has no other way
    std::string frame;  // as Image::frame
    int channels = 4;   // as Image::channels

    // Fills the strip, which has the picture's width and type, with the next rows; no more than
    // remain. Errors: as readImage. After one, only the destructor may follow.
    virtual Status read(Image& strip) = 0;
};

// Opens a picture. PNG, TIFF, EXR and HDR are read row by row, of any size (a row, or a row of tiles, within
// limits.imageBytes); the others, and interlaced PNG, are decoded whole, within limits.imageBytes. Errors: as
// readImage.
Result<std::unique_ptr<RowReader>> openRows(const std::filesystem::path& file, const LoadLimits& limits = {});

// What is to be written. Of the four components of a strip, alpha is left out unless asked for.
struct RowFormat {
    int width = 0, height = 0;
    PixelType type = PixelType::unorm8;
    bool alpha = false;
    bool half = false;      // .exr: floats of 16 bits
    std::string frame = {}; // as Image::frame; .png and .exr store it, others do not
};

// Takes the rows of a picture, from the top. The file appears with finish(); without it nothing is left.
class RowWriter {
public:
    virtual ~RowWriter() = default;
    // The next rows: as many as the strip has, of the width and type that were said.
    virtual Status write(const Image& strip) = 0;
    virtual Status finish() = 0;
};

// Begins a file; formats and errors as writeImage. threads: that compression may use, where it can; the bytes
// do not depend on it.
Result<std::unique_ptr<RowWriter>> createRows(const std::filesystem::path& file, const RowFormat& format,
                                              int threads = 1);

} // namespace cotan
