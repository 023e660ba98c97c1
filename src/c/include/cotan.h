/* Cotan for C and for bindings to other languages: plain arrays with sizes. The only global state is that of
 * cotan_set_reader. Any thread may call any function. Nothing depends on the locale that the program has chosen:
 * numbers in texts and files have a decimal point.
 *
 * Errors. Every function that can fail returns a cotan_status. If that is not COTAN_OK, `message` contains one line
 * with the reason, cut to `message_size` bytes including the terminating zero. Callers who need no text pass null and
 * 0. After an error no outputs have been written, unless the function says so.
 *
 * Structs. Each begins with its size in bytes. The caller sets it (COTAN_INIT), so that a library newer than the caller
 * knows which members exist. Structs for options, files and meshes may have the size of an older version; the newer
 * members are then 0.
 *
 * Data. Arrays of vectors are tightly packed floats, two or three per vector. Images are tightly packed red, green,
 * blue, alpha, with the top row first. Names of frames and other words are those of the command line, and so are
 * conventions: "gltf", "unity,xy". */
#ifndef COTAN_H
#define COTAN_H

#include <stddef.h>
#include <stdint.h>

#ifndef COTAN_NO_OLD_NAMES
#include "cotan_old_names.h"
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define COTAN_API_VERSION 9
/* clang-format off */
#ifdef __cplusplus
#define COTAN_INIT(type) cotan_init<type>()
#else
#define COTAN_INIT(type) { .size = sizeof(type) }
#endif
/* clang-format on */
#ifdef __cplusplus
/* Returns a struct with its size; all other members are 0. */
extern "C++" {
template<class Struct> inline Struct cotan_init()
{
    Struct made = Struct();
    made.size = sizeof(Struct);
    return made;
}
}
#endif

typedef enum cotan_status {
    COTAN_OK = 0,
    COTAN_USAGE = 1,       /* the call itself is wrong */
    COTAN_INPUT = 2,       /* a given array or value is bad */
    COTAN_UNAVAILABLE = 3, /* a required part is not built, or no memory */
    COTAN_OUTPUT = 4,
    COTAN_LIMIT = 5,
    COTAN_STOPPED = 6 /* the caller's progress function stopped the work */
} cotan_status;

/* "0.2.0", and the version of this header that the library was built with, which grows when functions are added. */
const char* cotan_version(void);
int cotan_api_version(void);

/* Bytes made by the library. The caller frees them; null is allowed. */
typedef struct cotan_bytes cotan_bytes;
const void* cotan_bytes_data(const cotan_bytes* bytes);
size_t cotan_bytes_size(const cotan_bytes* bytes);
void cotan_bytes_free(cotan_bytes* bytes);

/* Returns parts of file names for names of objects, materials or images, one line each. They are 1 to about 64 bytes
 * long, and neither leave a folder nor mean a device on any file system. All differ, also where case is ignored, from
 * one another and from those in `taken`; a name that needs no change keeps it. taken: may be null if taken_count is 0.
 * Since version 7. */
cotan_status cotan_file_names(size_t count, const char* const* names, size_t taken_count, const char* const* taken,
                              cotan_bytes** parts, char* message, size_t message_size);

/* Called by long work with the fraction done, 0 to 1. Calls do not overlap, but they may come from other threads than
 * the caller's, and the numbers may be out of order. To stop the work, return a number other than 0; the function then
 * soon returns COTAN_STOPPED. */
typedef int (*cotan_progress)(void* user, double done);

/* ---- frames ------------------------------------------------------------------------------------------------------ */

/* The names of the frames, 0 to count - 1; null for other numbers. */
int cotan_frame_count(void);
const char* cotan_frame_name(int frame);

/* Surface points: unit normals, and differences of position and uv along any two directions, such as pixels or
 * edges. */
typedef struct cotan_surface_points {
    size_t size;          /* of this struct */
    size_t count;         /* number of points */
    const float* normals; /* 3 each */
    const float* dpdx;    /* 3 each */
    const float* dpdy;    /* 3 each */
    const float* duvdx;   /* 2 each */
    const float* duvdy;   /* 2 each */
} cotan_surface_points;

/* Return perturbed unit normals for decoded texels (x along +u, y along +v, z outwards), or the inverse: the unit
 * texels that a frame maps to the given normals. `frame` is one that is made from differences ("cotangent",
 * "orthonormal", ...). Degenerate differences give the normal as it is, or the texel (0, 0, 1). */
cotan_status cotan_frame_apply(const char* frame, const cotan_surface_points* points, const float* texels,
                               float* normals, char* message, size_t message_size);
cotan_status cotan_frame_encode(const char* frame, const cotan_surface_points* points, const float* normals,
                                float* texels, char* message, size_t message_size);

/* The same for frames made at the vertices and interpolated: "mikktspace", "area-weighted" and "vertex" from tangents
 * of cotan_tangents, "smooth" from cotangents of cotan_smooth_cotangents. Normals are interpolated, of any length. */
typedef struct cotan_interpolated_points {
    size_t size;
    size_t count;
    const float* normals;      /* 3 each */
    const float* tangents;     /* 4 each, w as in glTF's TANGENT; null for "smooth" */
    const float* cotangents_u; /* 3 each; null for the others */
    const float* cotangents_v; /* 3 each; null for the others */
} cotan_interpolated_points;
cotan_status cotan_vertex_frame_apply(const char* frame, const cotan_interpolated_points* points, const float* texels,
                                      float* normals, char* message, size_t message_size);
cotan_status cotan_vertex_frame_encode(const char* frame, const cotan_interpolated_points* points, const float* normals,
                                       float* texels, char* message, size_t message_size);

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
    /* Since version 9. */
    const float* colors; /* 4 each: linear red, green, blue, alpha; null: none. Read by models and baking */
} cotan_mesh;

/* All functions that take a mesh refuse non-finite numbers (COTAN_INPUT), and name the first: "mesh.positions[7]:
 * ...". */

/* Returns one tangent per index: x, y, z along increasing u, w as in glTF's TANGENT. `kind`: "mikktspace",
 * "area-weighted" (meshoptimizer's default) or "vertex". threads: 0 for all cores; the result does not depend on it.
 * tangents: 4 * index_count floats. x, y, z are unit. Only "vertex" never gives (0, 0, 0, 1) or (0, 0, 0, -1) where
 * directions cancel at a vertex, as MikkTSpace does. glTF requires unit length: replace such a tangent by (1, 0, 0)
 * before you write a file. All functions of Cotan that write glTF do so. */
cotan_status cotan_tangents(const char* kind, const cotan_mesh* mesh, int threads, float* tangents, char* message,
                            size_t message_size);

/* Returns the cotangents of the frame "smooth", one pair per vertex: u and v, 3 * vertex_count floats each. */
cotan_status cotan_smooth_cotangents(const cotan_mesh* mesh, float* u, float* v, char* message, size_t message_size);

/* The same for large meshes: progress, which may be null, is called at least every 100 ms per million triangles, and
 * may stop the work (COTAN_STOPPED). "vertex" calls it only before and after its work. Since version 6. */
cotan_status cotan_tangents_with_progress(const char* kind, const cotan_mesh* mesh, int threads,
                                          cotan_progress progress, void* user, float* tangents, char* message,
                                          size_t message_size);
cotan_status cotan_smooth_cotangents_with_progress(const cotan_mesh* mesh, int threads, cotan_progress progress,
                                                   void* user, float* u, float* v, char* message, size_t message_size);

/* Return the same triangles with more vertices, so that per-corner results can be stored at vertices. A vertex is
 * copied if the corners that share it have different values (4 floats each, as from cotan_tangents), or if mirrored and
 * unmirrored triangles share it, as cotan_smooth_cotangents requires. split_indices: index_count indices of new
 * vertices. sources: for each new vertex the old one that it copies, the old ones first; space for
 * vertex_count + index_count. split_count: the number of new vertices. Since version 2. */
cotan_status cotan_split_vertices(size_t vertex_count, size_t index_count, const uint32_t* indices,
                                  const float* corners, uint32_t* split_indices, uint32_t* sources, size_t* split_count,
                                  char* message, size_t message_size);
cotan_status cotan_split_mirrored(const cotan_mesh* mesh, uint32_t* split_indices, uint32_t* sources,
                                  size_t* split_count, char* message, size_t message_size);

/* Returns U and V of the frame "triangle", one pair per triangle: index_count floats each. Since version 2. */
cotan_status cotan_triangle_vectors(const cotan_mesh* mesh, int threads, float* u, float* v, char* message,
                                    size_t message_size);

/* Compact encodings, which shaders/cotan/triangle.h and pack.h unpack: `triangle` in 3 words, `smooth` in four SNORM16
 * or one word, tangents (4 floats each) in one short. count: of triangles, or of vertices, whose unit normals must be
 * those that unpacking will use. Since version 2. */
cotan_status cotan_pack_triangles(size_t count, const float* u, const float* v, uint32_t* words, char* message,
                                  size_t message_size);
cotan_status cotan_pack_smooth8(size_t count, const float* normals, const float* u, const float* v, int16_t* packed,
                                char* message, size_t message_size);
cotan_status cotan_pack_smooth4(size_t count, const float* normals, const float* u, const float* v, uint32_t* packed,
                                char* message, size_t message_size);
cotan_status cotan_pack_tangents(size_t count, const float* normals, const float* tangents, uint16_t* packed,
                                 char* message, size_t message_size);

/* Returns the triangles over vertices numbered so that vertex k provokes triangle k: a vertex shader with vertex number
 * k then computes the values of the triangle. last: 0 if the first of the three vertices provokes (Vulkan, Direct3D,
 * Metal, WebGPU), otherwise 1 (OpenGL, WebGL). made_indices: index_count indices of new vertices. sources and
 * made_count: as above. corners: index_count indices of old vertices, each triangle rotated so that the provoking one
 * comes first. Since version 2. */
cotan_status cotan_provoking(size_t vertex_count, size_t index_count, const uint32_t* indices, int last,
                             uint32_t* made_indices, uint32_t* sources, size_t* made_count, uint32_t* corners,
                             char* message, size_t message_size);

/* ---- normal maps ------------------------------------------------------------------------------------------------- */

/* The pixels of an image, in memory that somebody else owns: width * height * 4 components of 8 or 16 bits, or floats
 * (32). At most 65536 pixels per side. */
typedef struct cotan_image_view {
    size_t size;
    int width, height;
    int bits;
    void* pixels; /* never null: read if the image is an input, written if it is an output */
} cotan_image_view;

typedef struct cotan_green {
    size_t size;
    int direction;    /* 1: green points up in the image; -1: down; 0: unknown */
    int swapped;      /* 1: red and green exchanged; 0: not; -1: unknown */
    int confidence;   /* 0 none, 1 likely, 2 certain */
    double agreement; /* correlation that the verdict is based on, -1 to 1 */
    char reason[256]; /* one sentence */
} cotan_green;

/* Detects the direction of green in a tangent-space map, from the map alone. */
cotan_status cotan_map_green(const cotan_image_view* map, cotan_green* green, char* message, size_t message_size);

/* Properties of an image as a normal map, derived from its values. Fractions are 0 to 1. */
typedef struct cotan_map_info {
    size_t size;
    char content[64];     /* a few words, such as "tangent space" or "one value everywhere" */
    int zero;             /* the code, of 255, that represents zero: 128; 127 for 127.5; 0: unknown */
    int srgb;             /* 1: stored as if it were a colour; -1: as if it had been decoded as a colour; 0: neither */
    double background;    /* fraction outside the charts, which the other members ignore */
    double invalid;       /* fraction that is no direction */
    double below_horizon; /* fraction with z below 0 */
    double mean_length;
    double mean_tilt; /* degrees from flat */
    double mean[3];   /* x, y, z, with green up */
} cotan_map_info;
cotan_status cotan_map_describe(const cotan_image_view* map, cotan_map_info* info, char* message, size_t message_size);

/* Converts a map to another convention. from: words; those for broken maps (srgb, linearised, bgr, grb) are repaired;
 * "auto" finds it and repairs the map, as `cotan map convert` does (COTAN_INPUT: green cannot be told). Two channels
 * are found wherever they are, here and in the functions below; a map without z (blue is the middle code everywhere, as
 * readers of two channels leave it) has two. `to_map` has the size of `map` and the requested bits. */
cotan_status cotan_map_convert(const cotan_image_view* map, const char* from, const char* to, cotan_image_view* to_map,
                               char* message, size_t message_size);

/* Makes the normal map of a height map, whose red is read; heights wrap around at the borders. scale_x, scale_y: slope
 * per unit of stored height and texel. */
cotan_status cotan_map_from_height(const cotan_image_view* height, double scale_x, double scale_y, const char* to,
                                   cotan_image_view* map, char* message, size_t message_size);

/* Returns the height whose slopes are closest to the map's, in texel widths, with mean 0: width * height floats. */
cotan_status cotan_map_to_height(const cotan_image_view* map, const char* from, float* heights, char* message,
                                 size_t message_size);

/* Blends a detail map over a base map of the same size; both and the result use `convention`. `mode`: "reoriented",
 * "whiteout", "udn", "slopes" or "linear". strength: factor on the slopes of the detail. */
cotan_status cotan_map_blend(const cotan_image_view* base, const cotan_image_view* detail, const char* convention,
                             const char* mode, double strength, cotan_image_view* map, char* message,
                             size_t message_size);

/* Makes mip levels from the map itself (level 0, re-encoded) to 1 x 1, each half the size, filtered as vectors. `take`
 * is called for each level in order, with the map and with the roughness (grey) that compensates for the variation lost
 * by averaging. Both are valid only during the call; a result other than 0 stops (COTAN_STOPPED). roughness: of the
 * material, 0 to 1. */
typedef int (*cotan_take_level)(void* user, int level, const cotan_image_view* map, const cotan_image_view* roughness);
cotan_status cotan_map_mips(const cotan_image_view* map, const char* convention, double roughness,
                            cotan_take_level take, void* user, char* message, size_t message_size);

typedef struct cotan_texture_options {
    size_t size;
    const char* from;      /* convention of the map, as for cotan_map_convert; null: "gltf,exact" */
    const char* to;        /* convention of the texture; null: as `from`. Formats of two channels hold its x and y */
    const char* compress;  /* as --compress of `cotan map convert`: "bc5", "uastc", "astc-6x6", ...; null: "none" */
    const char* swizzle;   /* as --swizzle: where two channels are; null: "auto" */
    const char* container; /* "ktx2" or "dds"; null: "ktx2" */
    const char* frame;     /* for which the map was made, which KTX2 stores; null: not stored */
    int mips;              /* not 0: all levels to 1 x 1, filtered as vectors; 0: the largest level only */
} cotan_texture_options;

/* Degrees between the map and the largest level as it is read. -1: this build cannot decode the file, as npm's cannot
 * decode DDS. */
typedef struct cotan_texture_result {
    size_t size;
    int levels;
    double mean_degrees, percentile99_degrees; /* 99 % of the texels are within the second */
} cotan_texture_result;

/* Makes the file that `cotan map convert` writes with the same words (and --mips), byte for byte. result may be null.
 * The caller frees the bytes. COTAN_UNAVAILABLE: this build has no encoder (ASTC). Since version 9. */
cotan_status cotan_map_texture(const cotan_image_view* map, const cotan_texture_options* options,
                               cotan_texture_result* result, cotan_bytes** texture, char* message, size_t message_size);

/* ---- shader text ------------------------------------------------------------------------------------------------- */

/* Returns the self-contained function that perturbs the normal with a frame, with a terminating zero. `language`: a
 * name for `cotan shader --lang`, such as "hlsl"; "godot" gives a whole spatial shader. `frame`: a name; null is
 * an error that says which frame is for which maps, but for "godot", where it means "orthonormal"; for "triangle" a
 * stage may follow, to which the text is then limited: "triangle,fragment", "triangle,vertex", "triangle,mesh" or
 * "triangle,compute". text_size: size of the buffer; set to the size of the text. A buffer that is too small, or null,
 * is not written, which is no error. */
cotan_status cotan_shader_text(const char* language, const char* frame, const char* convention, char* text,
                               size_t* text_size, char* message, size_t message_size);

/* ---- models ------------------------------------------------------------------------------------------------------ */

/* A model that the library has read, or that was made from meshes. The caller frees it; null is allowed. Since version
 * 3. */
typedef struct cotan_model cotan_model;
void cotan_model_free(cotan_model* model);

/* Reads a model file: .glb, .gltf, .obj, and with Assimp .ply, .stl, .dae, .fbx or .3ds: see cotan_set_reader. Missing
 * normals are generated. images: 0 omits the images of the materials, which baking of the shape does not need.
 * memory: limit for the largest image, in MiB; 0: 640. COTAN_UNAVAILABLE: the required reader is not built. Since
 * version 3. */
cotan_status cotan_model_open(const char* file, int images, int memory, cotan_model** model, char* message,
                              size_t message_size);

/* Third-party readers may crash on broken files. After this call a child process reads models other than glTF, and
 * images other than PNG and JPEG, so that a crash gives only COTAN_INPUT. The child is the program words[0], called
 * with the other words and one more; it must call cotan_reader_process before it does anything else. It may neither
 * write files nor start programs (Linux). count 0: files are read in this process, which is the default. Do not call it
 * while another call is in progress. Since version 3. */
cotan_status cotan_set_reader(size_t count, const char* const* words, char* message, size_t message_size);
/* Reads for the parent process, and ends this process. Returns an exit code only if no parent has requested a file.
 * Since version 3. */
int cotan_reader_process(void);

/* Makes a model from copies of meshes, whose normals and texcoords may be null; missing normals are generated smooth.
 * names: of the meshes; null, or a null in the array, for none. Since version 3. */
cotan_status cotan_model_of_meshes(size_t count, const cotan_mesh* const* meshes, const char* const* names,
                                   cotan_model** model, char* message, size_t message_size);

/* Sets the up axis of the model: "y", as everywhere here, or "z", as in PLY and STL of Blender and CAD, which rotates
 * the model by 90 degrees about x. Call it once per model, before it is used; a second "z" rotates it again. Since
 * version 5. */
cotan_status cotan_model_up(cotan_model* model, const char* up, char* message, size_t message_size);

/* Returns the warnings of the model, one line each, or ""; valid as long as the model. Since version 3. */
const char* cotan_model_warnings(const cotan_model* model);

/* ---- baking ------------------------------------------------------------------------------------------------------ */

typedef struct cotan_bake_options {
    size_t size;
    const char* frame; /* frame that will read the map; null: "mikktspace", which every engine reads */
    const char* kind;  /* "normal", "object-normal", "height", "ao" (before version 9 "occlusion", which stays); since
                          version 9 "bent-normal", "object-bent-normal", "thickness", "curvature", "position", and
                          of the detailed models' materials, which must have been opened with images:
                          "base-color", "roughness", "metallic", "roughness-metallic" (green, blue), "emissive",
                          "id"; colours are sRGB with 8 and 16 bits, else linear; and channels of maps of one value,
                          such as "R=ao,G=roughness,B=metallic,A=1", which is "orm"; null: "normal" */
    const char* convention;  /* of the map; null: "opengl" */
    int samples;             /* per texel and axis: 1, 2 or 4; 0: 2 (before version 9: 1) */
    int padding;             /* width of the filled border around charts, in texels; 0: fill everything, -1: none */
    int dither;              /* not 0: prevents banding in maps of 8 bits */
    int occlusion_rays;      /* rays per texel (before version 9 per sample), at least one per sample, also for bent
                                normals and thickness; 0: 64 */
    float max_distance;      /* detail further than this from the simple surface is ignored, in units of the positions;
                                0: 10 % of the diagonal of the simple surface's bounding box; for the search "nearest"
                                5 % of that of the detailed one */
    int threads;             /* 0: all cores; the result does not depend on it */
    cotan_progress progress; /* may be null */
    void* user;
    /* Since version 3. */
    const cotan_model* cage;     /* the triangles of the simple model, in the same order, moved outwards to enclose both
                                    models; rays start on it and go inwards. null: none */
    int match_by_name;           /* not 0: a simple mesh NAME_low is baked only from its detailed meshes NAME_high; the
                                    pairs are those of cotan_pair_names */
    int material;                /* of the simple model, from 1; 0: all */
    int tile;                    /* UDIM number; 0: 1001, with a warning of triangles on others */
    const char* tangents;        /* for "mikktspace" and "vertex": "stored" or "generated"; null: "generated" */
    const char* high_normals;    /* "smooth", "curved", "face" or "map" (from normal maps); null: "smooth" */
    const char* high_frame;      /* frame that the detailed models' maps were made for; null: "mikktspace" */
    const char* high_convention; /* of these maps; null: as the materials say, "opengl" for high_maps */
    size_t high_map_count;       /* 0, 1, or one per detailed model */
    const cotan_image_view* const* high_maps; /* used instead of the detailed models' own maps */
    cotan_image_view* mask; /* 8 bits, the size of the map: receives the state of each texel; null: not requested */
    float cage_reach; /* length of the rays from the cage; 0: as far behind the simple model as the cage is in front */
    /* Since version 4. */
    const char* search; /* "first": the first surface on a ray from outside inwards; "nearest": the nearest one along
                           the normal of the simple surface, in both directions; null: "first" */
    float extrusion;    /* distance before the simple surface at which rays start, in units of the positions; 0: derived
                           from the distance of the detailed surface */
    /* Since version 7. */
    const char* occluders; /* with match_by_name, what casts occlusion: "matched", the detailed meshes of the same name,
                              or "all"; null: "matched" */
    /* Since version 9. */
    float thickness_distance; /* thickness that integers store as 1; 0: 50 % of the detailed models' diagonal */
    float curvature_radius;   /* radius of a ball that integers store as 1, flat is 0.5; 0: 1 % of that diagonal */
    const char* rays;         /* which way they run: "auto", straight but averaged near hard edges, "averaged", along
                                 normals averaged over hard edges, "straight", along the normals of the simple model, or
                                 "vertex-color", straight where the red of the simple model's vertex colours is 1 and
                                 averaged where it is 0; no effect with a cage and for the search "nearest"; null:
                                 "auto" */
    const char* id_by;        /* what has a colour of its own in "id": "material", "object" or "vertex-color"; null:
                                 "material" */
    int wrap; /* 1: the simple model is one flat tile that fills the square of its uv once; what leaves it at a border
                 comes in at the opposite one */
    const cotan_image_view* rays_mask; /* replaces `rays`: an image in the uv of the simple model; rays are straight
                                          where its red is 1 and averaged where it is 0; null: none */
} cotan_bake_options;

typedef struct cotan_bake_result {
    size_t size;
    size_t texels, covered;
    size_t missed;   /* texels with a ray that found nothing */
    size_t negative; /* texels whose normal is below the horizon of the frame */
    size_t twice;    /* texels that several triangles cover */
    size_t rays;
    double ray_distance; /* the search distance used */
    /* Since version 4. */
    size_t further;   /* missed texels with a surface beyond the search distance */
    size_t nearer;    /* texels of the first surface from outside although another one is nearer */
    double ray_start; /* the largest distance before the simple surface at which a ray starts */
    /* Since version 9. */
    double unit;   /* of "thickness" and "curvature": the thickness or radius that integers store as 1; else 0 */
    double box[6]; /* of the detailed models: the lowest x, y, z, then the highest; 0 and 1 of "position" in integers */
    size_t disputed; /* texels of `twice` where the normals of these triangles differ by over 5 degrees */
    size_t problems; /* number of problem areas, 0 to 3, which the warnings describe; 0: the map can be used */
} cotan_bake_result;

/* Bakes a map for the simple mesh `low` from the detailed mesh `high`, whose texcoords may be null. `map` has the
 * requested size and bits. options and result may be null. COTAN_UNAVAILABLE: not built with Embree. */
cotan_status cotan_bake(const cotan_mesh* low, const cotan_mesh* high, const cotan_bake_options* options,
                        cotan_image_view* map, cotan_bake_result* result, char* message, size_t message_size);

/* Bakes a map for a simple model from all detailed models together. `warnings` may be null; it receives text, one line
 * each. Since version 3. */
cotan_status cotan_bake_models(const cotan_model* low, size_t high_count, const cotan_model* const* high,
                               const cotan_bake_options* options, cotan_image_view* map, cotan_bake_result* result,
                               cotan_bytes** warnings, char* message, size_t message_size);

/* The same for several maps, whose rays are traced once; each is as it would be alone. kinds: for each map a word of
 * options.kind, which a null stands for, all different. maps: of the same size, each with its own bits. results: null,
 * or for each map its result or null; what they count of texels and rays is the same for all. ids: may be null;
 * receives text, for a map of the kind "id" a line "#rrggbb NAME" for each material or object, with its colour there,
 * none by vertex colours. Since version 9. */
cotan_status cotan_bake_maps(const cotan_model* low, size_t high_count, const cotan_model* const* high,
                             const cotan_bake_options* options, size_t map_count, const char* const* kinds,
                             cotan_image_view* const* maps, cotan_bake_result* const* results, cotan_bytes** ids,
                             cotan_bytes** warnings, char* message, size_t message_size);

/* What the name of a mesh says that it is: "low" (NAME_low, NAME.lo.001, lp_NAME, ...), "high", "cage", or "". Since
 * version 7. */
const char* cotan_name_role(const char* name);

/* Pairs simple with detailed meshes by their names, as match_by_name does: "door_low" with "door_high" and
 * "door_high_bolts", "door_low.001" with "door_high.001". A simple mesh belongs to the detailed ones of the same group.
 * low_groups, high_groups: one number per name; -1: it has no counterpart. notes: what the names leave open, one line
 * each; may be null. Since version 7. */
cotan_status cotan_pair_names(size_t low_count, const char* const* low, size_t high_count, const char* const* high,
                              int64_t* low_groups, int64_t* high_groups, cotan_bytes** notes, char* message,
                              size_t message_size);

/* ---- glTF in memory ---------------------------------------------------------------------------------------------- */

/* Access to the files and images of a model. The functions are called on the caller's thread, one at a time. Each sets
 * a pointer to its result and returns 0, or returns another number if there is none. The library copies the data and
 * then calls `done`. The struct, and each function, may be null. */
typedef struct cotan_model_files {
    size_t size;
    void* user;
    /* Reads a file next to the model by its URI. If null, models that reference files are refused. */
    int (*read)(void* user, const char* uri, const void** bytes, size_t* byte_count);
    /* Decodes an image file of any format except KTX2 (in models PNG, JPEG, WebP, AVIF or DDS): sets all members of
     * `view` except `size`. If null, the library decodes. */
    int (*decode)(void* user, const char* name, const void* bytes, size_t byte_count, cotan_image_view* view);
    /* Encodes an image of 8 or 16 bits as a PNG file. It is decoded again, so that the report has what its losses cost.
     * If null, the library encodes. */
    int (*encode)(void* user, const cotan_image_view* view, const void** bytes, size_t* byte_count);
    void (*done)(void* user);
    const char* name; /* of the model in messages; null: "model.glb" or "model.gltf". Since version 3 */
} cotan_model_files;

/* Calls `take` for each image of the model that lint decodes or, with maps_only, that a conversion decodes, so that
 * callers can decode them beforehand if they cannot do so synchronously. bytes: valid only during the call. A result
 * other than 0 stops (COTAN_STOPPED). Since version 2. */
typedef int (*cotan_take_file)(void* user, const char* name, const void* bytes, size_t byte_count);
cotan_status cotan_gltf_images(const void* model, size_t model_size, const cotan_model_files* files, int maps_only,
                               cotan_take_file take, void* user, char* message, size_t message_size);

typedef struct cotan_lint_options {
    size_t size;
    double distance;         /* from the eye to the surface, in units of the model; 0: the whole model fills the
                                image */
    cotan_progress progress; /* may be null */
    void* user;
    /* Limits for a check, as in `cotan lint`; the report contains the verdict as "check". 0: no limit; 1e-9 allows
     * nothing. Since version 4. */
    double limit;       /* degrees that the error with `frame` may exceed on 5 % of the area */
    double limit_area;  /* % of a primitive's area with degenerate or mirrored overlapping uv, or wrong tangents */
    const char* frame;  /* cotangent, orthonormal, smooth, exact, triangle or stored; null: "orthonormal" */
    double max_degrees; /* as in cotan_convert_options, for the report's "decisions". Since version 8 */
} cotan_lint_options;

/* The main results of a report. Degrees are means over the surface, for the worst of the maps; -1: no map was
 * judged. */
typedef struct cotan_lint_result {
    size_t size;
    size_t primitives, maps;
    char advice[16];        /* the frame to read the maps with or to convert them for; empty: no change needed */
    size_t maps_to_convert; /* 0 since version 8: maps stay, and each primitive has the frame that reads them */
    int distrust_stored;    /* 1: stored tangents contradict the uv */
    size_t green_against;   /* maps whose green points in the other direction than the model says */
    double orthonormal_degrees, cotangent_degrees, smooth_degrees; /* errors of maps for MikkTSpace, read as they are */
    char recommendation[1024];                                     /* sentences, cut if they are longer */
} cotan_lint_result;

/* Predicts the errors of a model (.glb or .gltf as bytes) whose normal maps are read without stored tangents. options,
 * result and json may be null; json: the whole report, as text. */
cotan_status cotan_lint_gltf(const void* model, size_t model_size, const cotan_model_files* files,
                             const cotan_lint_options* options, cotan_lint_result* result, cotan_bytes** json,
                             char* message, size_t message_size);

/* The same for a model that includes its images, of any format. Since version 3. */
cotan_status cotan_lint_model(const cotan_model* model, const cotan_lint_options* options, cotan_lint_result* result,
                              cotan_bytes** json, char* message, size_t message_size);

#define COTAN_MAPS_UNREAD 2
typedef struct cotan_convert_options {
    size_t size;
    const char* from; /* frame that the maps were made for; null: the one named by the file, otherwise "mikktspace" */
    const char* to;   /* frame to convert the maps for; null: maps are kept, each primitive is read with the frame that
                         is near enough, which its extras name, and keeps its tangents where none is */
    int bits; /* of the new maps, 8 or 16; all maps are rewritten. 0: as the old maps, which are kept if they fit */
    int keep_tangents;       /* not 0: TANGENT is kept if the new frame does not read it */
    int generate_tangents;   /* not 0: tangents of `from` are generated even if the model has some */
    int threads;             /* 0: all cores; the result does not depend on it */
    cotan_progress progress; /* may be null */
    void* user;
    const char* expansion; /* how engines expand the values of the maps: "biased" (2c - 1) or "exact"; null: "biased" */
    /* Since version 5. */
    int keep_maps; /* not 0: maps are kept, byte for byte, to be read with `to`, which must not read tangents; only
                      tangents are removed. Where these reverse green of a map, its green is reversed, or they stay.
                      COTAN_MAPS_UNREAD: without decoding maps, which all stay as is, to be read with "orthonormal" if
                      `to` is null */
    /* Since version 8. */
    double max_degrees; /* if `to` is null: the mean error of normals that a frame may have on a primitive, and ten
                           times as much on 1 % of its area; 0: 0.3 */
} cotan_convert_options;

typedef struct cotan_convert_result {
    size_t size;
    size_t maps_converted, maps_kept;
    size_t primitives_given; /* primitives with new tangents */
    size_t tangent_bytes_dropped;
    /* Errors of the normals with the new frame: the mean over the surface of a map, for the worst of the maps. -1: no
     * map was judged. */
    double worst_degrees_before, worst_degrees_after;
} cotan_convert_result;

/* Converts a model's normal maps for another frame. glb: the new model, with all files of the old one inside. options,
 * result and json may be null. */
cotan_status cotan_convert_gltf(const void* model, size_t model_size, const cotan_model_files* files,
                                const cotan_convert_options* options, cotan_convert_result* result, cotan_bytes** glb,
                                cotan_bytes** json, char* message, size_t message_size);

/* The same in two steps, for callers who encode images asynchronously: begin gives a conversion with images of 8 or 16
 * bits to be encoded; end gives the model, after the PNG files of all images are set. files->encode is not called.
 * result and json as above; "bytes_after" in json is known after the second step. Since version 2. */
typedef struct cotan_conversion cotan_conversion;
cotan_status cotan_convert_begin(const void* model, size_t model_size, const cotan_model_files* files,
                                 const cotan_convert_options* options, cotan_convert_result* result,
                                 cotan_conversion** conversion, char* message, size_t message_size);
size_t cotan_conversion_count(const cotan_conversion* conversion);
cotan_status cotan_conversion_image(const cotan_conversion* conversion, size_t number, cotan_image_view* view,
                                    char* message, size_t message_size);
cotan_status cotan_conversion_set(cotan_conversion* conversion, size_t number, const void* png, size_t png_size,
                                  char* message, size_t message_size);
cotan_status cotan_convert_end(cotan_conversion* conversion, cotan_bytes** glb, cotan_bytes** json, char* message,
                               size_t message_size);
void cotan_conversion_free(cotan_conversion* conversion); /* null is allowed */

/* ---- images ------------------------------------------------------------------------------------------------------ */

/* An image made by the library. The caller frees it; null is allowed. Since version 3. */
typedef struct cotan_image cotan_image;
void cotan_image_free(cotan_image* image);
/* Returns size, bits and pixels of the image, valid as long as the image. */
cotan_status cotan_image_pixels(const cotan_image* image, cotan_image_view* view, char* message, size_t message_size);

/* Reads an image file without conversion: .png, .jpg, .webp, .ktx2, .dds, and with OpenImageIO .exr, .tif, .tga, .hdr
 * and more. memory: limit in MiB; 0: 640. Since version 3. */
cotan_status cotan_image_read(const char* file, int memory, cotan_image** image, char* message, size_t message_size);

/* Writes an image file, completely or not at all: .png, and with OpenImageIO .exr, .tif, .tga, .jpg and .hdr. Since
 * version 3. */
cotan_status cotan_image_write(const char* file, const cotan_image_view* image, char* message, size_t message_size);

typedef struct cotan_render_options {
    size_t size;
    size_t word_count;
    const char* const* words; /* as on the command line of `cotan render`: "--size", "640x360", "--frame", "smooth" */
    int floats;               /* not 0: as in a file of floats, with linear and unlimited light */
    int threads;              /* 0: all cores; the image does not depend on it */
    cotan_progress progress;  /* may be null */
    void* user;
} cotan_render_options;

/* Makes the image of `cotan render` with these words, without -o and other words about files. model: bytes of a .glb or
 * .gltf; null: the file that the words name, or the built-in scene. options, files and json may be null; json: what was
 * rendered, on which device, and warnings. Since version 3. */
cotan_status cotan_render(const void* model, size_t model_size, const cotan_model_files* files,
                          const cotan_render_options* options, cotan_image** image, cotan_bytes** json, char* message,
                          size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
