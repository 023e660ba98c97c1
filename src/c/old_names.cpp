// The functions whose names version 9 of cotan.h replaced, for programs that were linked before. The next version
// deletes this file, and cotan_old_names.h.
#include "cotan.h"

extern "C" {

cotan_status cotan_gltf_pictures(const void* model, size_t model_size, const cotan_model_files* files, int maps_only,
                                 cotan_take_file take, void* user, char* message, size_t message_size)
{
    return cotan_gltf_images(model, model_size, files, maps_only, take, user, message, message_size);
}

cotan_status cotan_conversion_picture(const cotan_conversion* conversion, size_t number, cotan_image_view* view,
                                      char* message, size_t message_size)
{
    return cotan_conversion_image(conversion, number, view, message, message_size);
}

cotan_status cotan_image_picture(const cotan_image* image, cotan_image_view* view, char* message, size_t message_size)
{
    return cotan_image_pixels(image, view, message, message_size);
}
}
