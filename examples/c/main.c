/* Uses the C API: tangents and a perturbed normal of one triangle, conversion of a map, shader text, a bake. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <cotan.h>

static void check(cotan_status status, const char* message)
{
    if (status != COTAN_OK) {
        fprintf(stderr, "%s\n", message);
        exit(status);
    }
}

/* Called with the fraction done, 0 to 1. Returning 1 would stop the work. */
static int progress(void* user, double done)
{
    *(double*)user = done;
    return 0;
}

int main(void)
{
    char message[256];
    printf("cotan %s, %d frames\n", cotan_version(), cotan_frame_count());

    /* A triangle in the plane z = 0 with u along -x. */
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1},
                uv[] = {1, 1, 0, 1, 1, 0};
    const uint32_t indices[] = {0, 1, 2};
    const cotan_mesh mesh = {sizeof mesh, 3, positions, normals, uv, 3, indices, NULL};
    float tangents[12];
    check(cotan_tangents("mikktspace", &mesh, 1, tangents, message, sizeof message), message);
    printf("tangent %g %g %g, w %g\n", tangents[0], tangents[1], tangents[2], tangents[3]);

    /* A frame without tangents, from differences of position and uv, applied to a texel that leans towards +u. */
    const float dpdx[] = {1, 0, 0}, dpdy[] = {0, 1, 0}, duvdx[] = {-1, 0}, duvdy[] = {0, -1}, texel[] = {0.6f, 0, 0.8f};
    const cotan_surface_points point = {sizeof point, 1, normals, dpdx, dpdy, duvdx, duvdy};
    float normal[3], back[3];
    check(cotan_frame_apply("cotangent", &point, texel, normal, message, sizeof message), message);
    check(cotan_frame_encode("cotangent", &point, normal, back, message, sizeof message), message);
    printf("normal %g %g %g\n", normal[0], normal[1], normal[2]);

    /* Converts one texel from Direct3D's convention to OpenGL's: green is reversed about 128, which stands for zero. */
    uint8_t pixels[] = {128, 200, 230, 255}, converted[4];
    const cotan_image_view map = {sizeof map, 1, 1, 8, pixels};
    cotan_image_view out = {sizeof out, 1, 1, 8, converted};
    check(cotan_map_convert(&map, "directx", "opengl", &out, message, sizeof message), message);
    printf("texel %d %d %d\n", converted[0], converted[1], converted[2]);

    size_t size = 0;
    check(cotan_shader_text("glsl", "cotangent", "gltf", NULL, &size, message, sizeof message), message);
    char* text = malloc(size);
    check(cotan_shader_text("glsl", "cotangent", "gltf", text, &size, message, sizeof message), message);
    printf("shader of %zu bytes\n", size - 1);
    free(text);

    /* Bakes the triangle, with normals tilted towards -x, onto itself. Unavailable if the library lacks Embree. */
    const float leaning[] = {-0.6f, 0, 0.8f, -0.6f, 0, 0.8f, -0.6f, 0, 0.8f};
    const cotan_mesh detailed = {sizeof detailed, 3, positions, leaning, NULL, 3, indices, NULL};
    double done = 0;
    cotan_bake_options options = COTAN_INIT(cotan_bake_options);
    options.progress = progress;
    options.user = &done;
    uint8_t baked[8 * 8 * 4];
    cotan_image_view baked_map = {sizeof baked_map, 8, 8, 8, baked};
    const cotan_status made = cotan_bake(&mesh, &detailed, &options, &baked_map, NULL, message, sizeof message);
    if (made == COTAN_UNAVAILABLE)
        printf("%s\n", message);
    else
        check(made, message);
    /* Since u runs along -x, the normals lean towards +u: 0.6 of 127 steps above 128. */
    const int baked_right =
        made == COTAN_UNAVAILABLE || (baked[0] == 204 && baked[1] == 128 && baked[2] == 230 && done == 1);
    printf("baked %d %d %d\n", made == COTAN_OK ? baked[0] : 0, made == COTAN_OK ? baked[1] : 0,
           made == COTAN_OK ? baked[2] : 0);

    /* Errors come with a message of one line. */
    const cotan_status status = cotan_frame_apply("nonsense", &point, texel, normal, message, sizeof message);
    printf("%d: %s\n", (int)status, message);
    const int right = tangents[0] < -0.999f && normal[0] < 0 && fabsf(back[0] - 0.6f) < 1e-5f && converted[0] == 128
        && converted[1] == 56 && converted[2] == 230 && status == COTAN_USAGE && baked_right;
    return right ? 0 : 1;
}
