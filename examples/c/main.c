/* The C API: tangents and a perturbed normal of one triangle, a map stored another way, and a shader. */
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

int main(void)
{
    char message[256];
    printf("cotan %s, %d frames\n", cotan_version(), cotan_frame_count());

    /* A triangle in the plane z = 0 whose u runs against x. */
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1}, uv[] = {1, 1, 0, 1, 1, 0};
    const uint32_t indices[] = {0, 1, 2};
    const cotan_mesh mesh = {sizeof mesh, 3, positions, normals, uv, 3, indices};
    float tangents[12];
    check(cotan_tangents("mikktspace", &mesh, 1, tangents, message, sizeof message), message);
    printf("tangent %g %g %g, w %g\n", tangents[0], tangents[1], tangents[2], tangents[3]);

    /* The same without tangents: edges and differences of uv, and a texel that leans towards +u. */
    const float dpdx[] = {1, 0, 0}, dpdy[] = {0, 1, 0}, duvdx[] = {-1, 0}, duvdy[] = {0, -1}, texel[] = {0.6f, 0, 0.8f};
    const cotan_places place = {sizeof place, 1, normals, dpdx, dpdy, duvdx, duvdy};
    float normal[3], back[3];
    check(cotan_frame_apply("cotangent", &place, texel, normal, message, sizeof message), message);
    check(cotan_frame_encode("cotangent", &place, normal, back, message, sizeof message), message);
    printf("normal %g %g %g\n", normal[0], normal[1], normal[2]);

    /* One texel from Direct3D's convention to glTF's: green turns, and 128 is zero. */
    uint8_t pixels[] = {128, 200, 230, 255}, turned[4];
    const cotan_picture map = {sizeof map, 1, 1, 8, pixels};
    cotan_picture out = {sizeof out, 1, 1, 8, turned};
    check(cotan_map_convert(&map, "directx", "gltf", &out, message, sizeof message), message);
    printf("texel %d %d %d\n", turned[0], turned[1], turned[2]);

    size_t size = 0;
    check(cotan_shader_text("glsl", "cotangent", "gltf", NULL, &size, message, sizeof message), message);
    char* text = malloc(size);
    check(cotan_shader_text("glsl", "cotangent", "gltf", text, &size, message, sizeof message), message);
    printf("shader of %zu bytes\n", size - 1);
    free(text);

    /* What is wrong is said in one line. */
    const cotan_status status = cotan_frame_apply("nonsense", &place, texel, normal, message, sizeof message);
    printf("%d: %s\n", (int)status, message);
    const int right = tangents[0] < -0.999f && normal[0] < 0 && fabsf(back[0] - 0.6f) < 1e-5f && turned[0] == 128
        && turned[1] == 56 && turned[2] == 230 && status == COTAN_USAGE;
    return right ? 0 : 1;
}
