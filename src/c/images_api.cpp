// cotan.h: pictures that the library has made.
#include "pictures.hpp"

using namespace cotan;
using namespace cotan::c;

void cotan_image_free(cotan_image* image) { delete image; }

cotan_status cotan_image_picture(const cotan_image* image, cotan_picture* picture, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(image, "image: expected one, found null");
        checked(picture, "picture");
        *picture = pictureOf(image->image);
    });
}
