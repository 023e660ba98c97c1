/* A program for version 8 of cotan.h compiles, links and works: it uses the names that version 9 replaced. Deleted with
 * cotan_old_names.h. */
#include <stdio.h>
#include <string.h>

#include <cotan.h>

static int take(void* user, const char* name, const void* bytes, size_t byte_count)
{
    (void)name, (void)bytes, (void)byte_count;
    ++*(int*)user;
    return 0;
}

static int takes_level(void* user, int level, const struct cotan_picture* map, const cotan_picture* roughness)
{
    (void)level, (void)roughness;
    *(int*)user += map->width;
    return 0;
}

static int expect(int holds, const char* what, const char* message)
{
    if (!holds)
        fprintf(stderr, "%s: %s\n", what, message);
    return holds ? 0 : 1;
}

int main(void)
{
    char message[256] = "";
    const float normal[] = {0, 0, 1}, dpdx[] = {1, 0, 0}, dpdy[] = {0, 1, 0}, duvdx[] = {-1, 0}, duvdy[] = {0, 1};
    const float texel[] = {0.6f, 0, 0.8f}, tangent[] = {-1, 0, 0, 1};
    const struct cotan_places place = {sizeof place, 1, normal, dpdx, dpdy, duvdx, duvdy};
    const cotan_vertex_places interpolated = {sizeof interpolated, 1, normal, tangent, NULL, NULL};
    float out[3];
    int wrong = 0, count = 0;
    wrong += expect(cotan_frame_apply("cotangent", &place, texel, out, message, sizeof message) == COTAN_OK
                        && out[0] < -0.59f,
                    "places", message);
    wrong += expect(cotan_vertex_frame_apply("vertex", &interpolated, texel, out, message, sizeof message) == COTAN_OK
                        && out[0] < -0.59f,
                    "vertex places", message);
    unsigned char pixels[4 * 4 * 4];
    memset(pixels, 128, sizeof pixels);
    cotan_picture picture = COTAN_INIT(cotan_picture);
    picture.width = picture.height = 4;
    picture.bits = 8;
    picture.pixels = pixels;
    wrong += expect(cotan_map_mips(&picture, "gltf", 0.5, takes_level, &count, message, sizeof message) == COTAN_OK
                        && count == 4 + 2 + 1,
                    "picture", message);
    /* Functions that need a model or an image: the new functions answer, with one line. */
    cotan_status status = cotan_image_picture(NULL, &picture, message, sizeof message);
    wrong += expect(status == COTAN_USAGE, "image picture", message);
    status = cotan_conversion_picture(NULL, 0, &picture, message, sizeof message);
    wrong += expect(status == COTAN_USAGE || status == COTAN_UNAVAILABLE, "conversion picture", message);
    status = cotan_gltf_pictures("{", 1, NULL, 0, take, &count, message, sizeof message);
    wrong += expect(status == COTAN_INPUT || status == COTAN_UNAVAILABLE, "pictures of a glTF", message);
    return wrong;
}
