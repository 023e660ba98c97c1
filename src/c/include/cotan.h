/* Cotan for C and for bindings to other languages: plain arrays with sizes, no global state, any number of threads.
 *
 * Every function that can fail returns a cotan_status. Where that is not COTAN_OK, one line is in `message`, cut to
 * `message_size` bytes with its zero; a null pointer and 0 are fine. Nothing is written to outputs then, unless said.
 *
 * Structs begin with their size in bytes, which the caller sets (COTAN_INIT): a newer library goes on to understand older
 * callers. Arrays of vectors are packed floats, three or two to a vector. Pictures are packed red, green, blue, alpha,
 * rows from the top. Names are those of the command line; conventions are its words, such as "gltf" or "unity,xyz". */
#ifndef COTAN_H
#define COTAN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define COTAN_API_VERSION 1
#define COTAN_INIT(type) { sizeof(type) }

typedef enum cotan_status {
    COTAN_OK = 0,
    COTAN_USAGE = 1,       /* the call itself is wrong */
    COTAN_INPUT = 2,       /* an array or value given is bad */
    COTAN_UNAVAILABLE = 3, /* not in this build, or no memory */
    COTAN_OUTPUT = 4,
    COTAN_LIMIT = 5
} cotan_status;

/* "0.1.0", and the version of this header that the library was built with: it grows where functions are added. */
const char* cotan_version(void);
int cotan_api_version(void);

/* ---- frames ------------------------------------------------------------------------------------------------------ */

/* Names of the frames, 0 to count - 1; null beyond. */
int cotan_frame_count(void);
const char* cotan_frame_name(int frame);

/* Places on a surface: unit normals, and differences of position and uv along any two directions, pixels or edges. */
typedef struct cotan_places {
    size_t size;           /* of this struct */
    size_t count;          /* of places */
    const float* normals;  /* 3 each */
    const float* dpdx;     /* 3 each */
    const float* dpdy;     /* 3 each */
    const float* duvdx;    /* 2 each */
    const float* duvdy;    /* 2 each */
} cotan_places;

/* Perturbed unit normals from decoded texels (x along +u, y along +v, z outwards), and the other way: the unit texels
 * that a frame turns into these normals. `frame` is one that is made from differences ("cotangent", "orthonormal", ...).
 * Degenerate differences give the normal as it is, or the texel (0, 0, 1). */
cotan_status cotan_frame_apply(const char* frame, const cotan_places* places, const float* texels, float* normals,
                               char* message, size_t message_size);
cotan_status cotan_frame_encode(const char* frame, const cotan_places* places, const float* normals, float* texels,
                                char* message, size_t message_size);

/* ---- tangents ---------------------------------------------------------------------------------------------------- */

/* An indexed mesh of triangles. */
typedef struct cotan_mesh {
    size_t size;
    size_t vertex_count;
    const float* positions;  /* 3 each */
    const float* normals;    /* 3 each */
    const float* texcoords;  /* 2 each, v down as in glTF */
    size_t index_count;      /* a multiple of 3 */
    const uint32_t* indices; /* each below vertex_count */
} cotan_mesh;

/* One tangent for each index: x, y, z along increasing u, w as glTF's TANGENT. `kind`: "mikktspace" or "vertex".
 * threads: 0 for all cores; the result does not depend on it. tangents: 4 * index_count floats. */
cotan_status cotan_tangents(const char* kind, const cotan_mesh* mesh, int threads, float* tangents,
                            char* message, size_t message_size);

/* The cotangents of the frame "smooth", one pair for each vertex: u and v, 3 * vertex_count floats each. */
cotan_status cotan_smooth_cotangents(const cotan_mesh* mesh, float* u, float* v, char* message, size_t message_size);

/* ---- normal maps ------------------------------------------------------------------------------------------------- */

/* A picture: width * height * 4 components of 8 or 16 bits, or floats (32). At most 65536 a side. */
typedef struct cotan_picture {
    size_t size;
    int width, height;
    int bits;
    void* pixels; /* read where the picture is an input; of an output written, and there for all of them */
} cotan_picture;

typedef struct cotan_green {
    size_t size;
    int direction;    /* 1: green points up the picture; -1: down; 0: cannot be told */
    int swapped;      /* 1: red and green exchanged; 0: not; -1: cannot be told */
    int confidence;   /* 0 none, 1 likely, 2 certain */
    double agreement; /* correlation that the verdict rests on, -1 to 1 */
    char reason[256]; /* one sentence */
} cotan_green;

/* Which way green of a map of tangent space points, from the map alone. */
cotan_status cotan_map_green(const cotan_picture* map, cotan_green* green, char* message, size_t message_size);

/* The map stored another way. `to_map` has the size of `map` and the bits that are wanted. */
cotan_status cotan_map_convert(const cotan_picture* map, const char* from, const char* to, cotan_picture* to_map,
                               char* message, size_t message_size);

/* The normal map of a height picture, whose red is read; heights repeat over the borders. scale_x, scale_y: slope per
 * unit of stored height and texel. */
cotan_status cotan_map_from_height(const cotan_picture* height, double scale_x, double scale_y, const char* to,
                                   cotan_picture* map, char* message, size_t message_size);

/* The height whose slopes are nearest to the map's, in widths of a texel, mean 0: width * height floats. */
cotan_status cotan_map_to_height(const cotan_picture* map, const char* from, float* heights,
                                 char* message, size_t message_size);

/* A base map with a detail map over it, of the base's size; both and the result are stored as `convention` says. `mode`:
 * "reoriented", "whiteout", "udn", "slopes" or "linear". strength: factor on the detail's slopes. */
cotan_status cotan_map_blend(const cotan_picture* base, const cotan_picture* detail, const char* convention,
                             const char* mode, double strength, cotan_picture* map, char* message, size_t message_size);

/* Levels of half the size each, down to 1 x 1, filtered as vectors. `take` gets each, largest first, with the map and with
 * the roughness (grey) that makes up for what averaging took; both are gone when it returns, and another result than 0
 * stops (COTAN_USAGE). roughness: of the material, 0 to 1. */
typedef int (*cotan_take_level)(void* user, int level, const cotan_picture* map, const cotan_picture* roughness);
cotan_status cotan_map_mips(const cotan_picture* map, const char* convention, double roughness, cotan_take_level take,
                            void* user, char* message, size_t message_size);

/* ---- shader text ------------------------------------------------------------------------------------------------- */

/* The function that perturbs the normal with that frame, self-contained, with a zero at its end. `language`: "glsl", "essl",
 * "hlsl", "wgsl", "msl" or "cpp". text_size: of the buffer; afterwards what the text takes. A buffer that is too small,
 * or null, is left alone and is no error. */
cotan_status cotan_shader_text(const char* language, const char* frame, const char* convention, char* text,
                               size_t* text_size, char* message, size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
