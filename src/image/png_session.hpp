// libpng's sessions, for whole pictures and for rows. libpng reports errors by calling back and leaves by
// longjmp, so the functions that call it hold nothing with a destructor.
#pragma once

#include <cstddef>
#include <cstdio>

#include <png.h>

#include "cotan/image.hpp"
#include "image/checks.hpp"

namespace cotan {

// What libpng's callbacks share with us.
struct PngSession {
    const png_byte* next = nullptr; // reading from memory: the bytes not yet consumed
    std::size_t left = 0;
    std::FILE* in = nullptr;  // reading from a file
    std::FILE* out = nullptr; // writing
    char message[128] = "";
    char frame[kMaxFrameText + 1] = ""; // reading: Image::frame, of chunks met so far
};

struct PngReader {
    PngSession session;
    png_structp png = nullptr;
    png_infop info = nullptr; // null: out of memory

    explicit PngReader(const PngSession& from); // does not close its file
    ~PngReader();
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
};

struct PngHeader {
    png_uint_32 width = 0;
    png_uint_32 height = 0;
    PixelType type = PixelType::unorm8;
    bool interlaced = false;
    bool alpha = false; // of its own, or a transparent colour
    int channels = 4;   // Image::channels
};

// Reads up to the pixel data and asks for RGBA. False: PngSession::message says why.
bool readPngHeader(PngReader& reader, PngHeader& header);

// Begins with the pixels: their rows have rowBytes.
bool startPngPixels(PngReader& reader, std::size_t rowBytes, bool interlaced, int& passes);

// Decodes `count` rows into `pixels`, rowBytes apart.
bool readPngRows(PngReader& reader, png_bytep pixels, std::size_t count, std::size_t rowBytes);

// Reads to the end of the file.
bool endPngPixels(PngReader& reader);

// Measured on 2048 x 2048 maps: a third larger than with libpng's defaults, in a fifth of the
// time (180 ms).
struct PngEffort {
    int level, filters;
};
constexpr PngEffort kQuickPng{2, PNG_FILTER_UP};
constexpr PngEffort kSmallPng{6, PNG_ALL_FILTERS}; // libpng's defaults

struct PngWriter {
    PngSession session;
    png_structp png = nullptr;
    png_infop info = nullptr; // null: out of memory

    explicit PngWriter(std::FILE* out); // does not close it
    ~PngWriter();
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
};

// Begins with the pixels, of unorm8 or unorm16; without alpha that of the rows is dropped.
bool startPng(PngWriter& writer, const RowFormat& format, PngEffort effort);
bool writePngRows(PngWriter& writer, png_const_bytep pixels, std::size_t count, std::size_t rowBytes);
bool endPng(PngWriter& writer);

} // namespace cotan
