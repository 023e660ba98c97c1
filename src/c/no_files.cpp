// cotan.h: files of models and pictures, and drawing, where what they need is not there.
#include "call.hpp"
#include "core/not_built.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

Error noFiles() { return notBuiltWith("files", "libfmt-dev, nlohmann-json3-dev, libpng-dev and libjpeg-dev"); }

} // namespace

#define COTAN_REFUSES(function, ...)                                                                                   \
    cotan_status function(__VA_ARGS__, char* message, size_t message_size)                                             \
    {                                                                                                                  \
        return refused(noFiles(), message, message_size);                                                              \
    }

COTAN_REFUSES(cotan_model_open, const char*, int, int, cotan_model**)
COTAN_REFUSES(cotan_set_reader, size_t, const char* const*)

int cotan_reader_process(void) { return COTAN_UNAVAILABLE; }

COTAN_REFUSES(cotan_image_read, const char*, int, cotan_image**)
COTAN_REFUSES(cotan_image_write, const char*, const cotan_picture*)
COTAN_REFUSES(cotan_render, const void*, size_t, const cotan_model_files*, const cotan_render_options*, cotan_image**,
              cotan_bytes**)
