/* c_formats IMAGE OUTPUT...: reads an image, and writes it in the format of each output by the C API: as an image, or,
 * where the name begins with a word of `--compress` and a dot (bc7.map.ktx2), as a texture. Reads each image again. */
#include <stdio.h>
#include <string.h>

#include <cotan.h>

static char message[512];

static int failed(const char* file)
{
    fprintf(stderr, "%s: %s\n", file, message);
    return 1;
}

static int write_texture(const char* file, const cotan_image_view* view)
{
    char word[32] = "";
    cotan_bytes* texture = NULL;
    cotan_texture_options options = COTAN_INIT(cotan_texture_options);
    strncpy(word, file, strcspn(file, ".") < 31 ? strcspn(file, ".") : 31);
    options.from = options.to = "opengl";
    options.compress = word;
    options.container = strrchr(file, '.') + 1;
    if (cotan_map_texture(view, &options, NULL, &texture, message, sizeof message) != COTAN_OK)
        return failed(file);
    FILE* out = fopen(file, "wb");
    size_t size = cotan_bytes_size(texture), written = out ? fwrite(cotan_bytes_data(texture), 1, size, out) : 0;
    if (out)
        fclose(out);
    cotan_bytes_free(texture);
    return written == size ? 0 : 1;
}

int main(int argc, char** argv)
{
    cotan_image *image = NULL, *again = NULL;
    cotan_image_view view = COTAN_INIT(cotan_image_view), read = COTAN_INIT(cotan_image_view);
    if (argc < 3 || cotan_image_read(argv[1], 0, &image, message, sizeof message) != COTAN_OK
        || cotan_image_pixels(image, &view, message, sizeof message) != COTAN_OK)
        return failed(argc < 2 ? "no image" : argv[1]);
    for (int i = 2; i < argc; ++i) {
        int texture = strchr(argv[i], '.') != strrchr(argv[i], '.');
        if (texture ? write_texture(argv[i], &view)
                    : cotan_image_write(argv[i], &view, message, sizeof message) != COTAN_OK)
            return failed(argv[i]);
        if (cotan_image_read(argv[i], 0, &again, message, sizeof message) != COTAN_OK
            || cotan_image_pixels(again, &read, message, sizeof message) != COTAN_OK)
            return failed(argv[i]);
        printf("%s: %d x %d, %d bits, %d\n", argv[i], read.width, read.height, read.bits,
               ((const unsigned char*)read.pixels)[1]);
        cotan_image_free(again);
    }
    cotan_image_free(image);
    return 0;
}
