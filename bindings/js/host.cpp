// Callbacks of the library that JavaScript implements: files, images, mip levels, progress. The functions of the module
// `cotan` are in src/host.js.
#include <cstdlib>

#include "c/call.hpp"
#include "c/image_views.hpp"
#include "cotan/image.hpp"

#define COTAN_FROM_HOST(name) __attribute__((import_module("cotan"), import_name(name)))

extern "C" {
COTAN_FROM_HOST("read") int hostRead(void* user, const char* uri, const void** bytes, size_t* byteCount);
COTAN_FROM_HOST("decode")
int hostDecode(void* user, const char* name, const void* bytes, size_t byteCount, cotan_image_view* view);
COTAN_FROM_HOST("done") void hostDone(void* user);
COTAN_FROM_HOST("progress") int hostProgress(void* user, double done);
COTAN_FROM_HOST("take_level")
int hostTakeLevel(void* user, int level, const cotan_image_view* map, const cotan_image_view* roughness);
COTAN_FROM_HOST("take_file") int hostTakeFile(void* user, const char* name, const void* bytes, size_t byteCount);

// Address of the function with this number in kFunction of src/host.js, for the structs that JavaScript fills.
void* cotan_js_function(int number)
{
    switch (number) {
    case 0: return reinterpret_cast<void*>(&hostRead);
    case 1: return reinterpret_cast<void*>(&hostDecode);
    case 2: return reinterpret_cast<void*>(&hostDone);
    case 3: return reinterpret_cast<void*>(&hostProgress);
    case 4: return reinterpret_cast<void*>(&hostTakeLevel);
    case 5: return reinterpret_cast<void*>(&hostTakeFile);
    default: return nullptr;
    }
}

// Decodes a KTX2 file, which no browser does. The caller frees the pixels.
cotan_status cotan_js_ktx2(const char* name, const void* bytes, size_t byteCount, cotan_image_view* view, char* message,
                           size_t messageSize)
{
    return cotan::c::call(message, messageSize, [&] {
        const auto image =
            cotan::c::valueOf(cotan::decodeImage({static_cast<const std::byte*>(bytes), byteCount}, name, {}));
        *view = cotan::c::imageViewOf(image);
        view->pixels = std::malloc(image.data.size());
        if (!view->pixels)
            cotan::c::fail(cotan::ErrorKind::unavailable, name, ": not enough memory for the image");
        cotan::c::put(image, *view);
    });
}
}
