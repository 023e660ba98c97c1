/* Cotan for C and for bindings to other languages: plain arrays with sizes. There is no global state but what
 * cotan_set_reader sets. Any thread may call any function.
 *
 * Errors. Every function that can fail returns a cotan_status. Where that is not COTAN_OK, `message` holds one line
 * that says why. It is cut to `message_size` bytes, the zero at its end included. A caller who wants no text passes a
 * null pointer and 0. After an error nothing has been written to the outputs, unless the function says so.
 *
 * Structs. Each begins with its size in bytes. The caller sets it (COTAN_INIT), so that a library that is newer than
 * the caller knows which members are there. Options and files that end where they did in an older version are fine:
 * what came later is 0 then.
 *
 * Data. Arrays of vectors are floats without gaps, two or three to a vector. Pictures are red, green, blue, alpha
 * without gaps, rows from the top. Names of frames and other words are those of the command line. So are conventions:
 * "gltf", "unity,xy". */
#ifndef COTAN_H
#define COTAN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define COTAN_API_VERSION 6
/* clang-format off */
#ifdef __cplusplus
#define COTAN_INIT(type) cotan_init<type>()
#else
#define COTAN_INIT(type) { .size = sizeof(type) }
#endif
/* clang-format on */
#ifdef __cplusplus
/* A struct with its size, all else 0. */
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
    COTAN_INPUT = 2,       /* an array or value given is bad */
    COTAN_UNAVAILABLE = 3, /* not built with what it needs, or no memory */
    COTAN_OUTPUT = 4,
    COTAN_LIMIT = 5,
    COTAN_STOPPED = 6 /* by the caller's progress function */
} cotan_status;

/* "0.2.0", and the version of this header that the library was built with: it grows where functions are added. */
const char* cotan_version(void);
int cotan_api_version(void);

/* Bytes that the library has made. They are the caller's, who frees them; null is fine. */
typedef struct cotan_bytes cotan_bytes;
const void* cotan_bytes_data(const cotan_bytes* bytes);
size_t cotan_bytes_size(const cotan_bytes* bytes);
void cotan_bytes_free(cotan_bytes* bytes);

/* Long work calls this to say how much is done, 0 to 1. There is one call at a time. It may come from another thread
 * than the caller's, and numbers may arrive out of order. To stop the work, return another number than 0: the function
 * then ends soon with COTAN_STOPPED. */
typedef int (*cotan_progress)(void* user, double done);

/* ---- frames ------------------------------------------------------------------------------------------------------ */

/* Names of the frames, 0 to count - 1; null beyond. */
int cotan_frame_count(void);
const char* cotan_frame_name(int frame);

/* Places on a surface: unit normals, and differences of position and uv along any two directions, pixels or edges. */
typedef struct cotan_places {
    size_t size;          /* of this struct */
    size_t count;         /* of places */
    const float* normals; /* 3 each */
    const float* dpdx;    /* 3 each */
    const float* dpdy;    /* 3 each */
    const float* duvdx;   /* 2 each */
    const float* duvdy;   /* 2 each */
} cotan_places;

/* Perturbed unit normals from decoded texels (x along +u, y along +v, z outwards), and the other way: the unit texels
 * that a frame turns into these normals. `frame` is one that is made from differences ("cotangent", "orthonormal",
 * ...). Degenerate differences give the normal as it is, or the texel (0, 0, 1). */
cotan_status cotan_frame_apply(const char* frame, const cotan_places* places, const float* texels, float* normals,
                               char* message, size_t message_size);
cotan_status cotan_frame_encode(const char* frame, const cotan_places* places, const float* normals, float* texels,
                                char* message, size_t message_size);

/* The same for the frames that are made at the vertices, interpolated to the places: "mikktspace" and "vertex" from
 * tangents as cotan_tangents makes them, "smooth" from cotangents as cotan_smooth_cotangents makes them. Normals are
 * interpolated, of any length. */
typedef struct cotan_vertex_places {
    size_t size;
    size_t count;
    const float* normals;      /* 3 each */
    const float* tangents;     /* 4 each, w as glTF's TANGENT; null for "smooth" */
    const float* cotangents_u; /* 3 each; null for the others */
    const float* cotangents_v; /* 3 each; null for the others */
} cotan_vertex_places;
cotan_status cotan_vertex_frame_apply(const char* frame, const cotan_vertex_places* places, const float* texels,
                                      float* normals, char* message, size_t message_size);
cotan_status cotan_vertex_frame_encode(const char* frame, const cotan_vertex_places* places, const float* normals,
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
} cotan_mesh;

/* All functions that take a mesh refuse one with numbers that are not finite (COTAN_INPUT), and name the first:
 * "mesh.positions[7]: ...". */

/* One tangent for each index: x, y, z along increasing u, w as glTF's TANGENT. `kind`: "mikktspace" or "vertex".
 * threads: 0 for all cores; the result does not depend on it. tangents: 4 * index_count floats. */
cotan_status cotan_tangents(const char* kind, const cotan_mesh* mesh, int threads, float* tangents, char* message,
                            size_t message_size);

/* The cotangents of the frame "smooth", one pair for each vertex: u and v, 3 * vertex_count floats each. */
cotan_status cotan_smooth_cotangents(const cotan_mesh* mesh, float* u, float* v, char* message, size_t message_size);

/* The same two for large meshes: progress, which may be null, is called at least once in a hundred milliseconds a
 * million triangles, and may stop them (COTAN_STOPPED). "vertex" calls it before and after its work. Since version 6.
 */
cotan_status cotan_tangents_with_progress(const char* kind, const cotan_mesh* mesh, int threads,
                                          cotan_progress progress, void* user, float* tangents, char* message,
                                          size_t message_size);
cotan_status cotan_smooth_cotangents_with_progress(const cotan_mesh* mesh, int threads, cotan_progress progress,
                                                   void* user, float* u, float* v, char* message, size_t message_size);

/* The same triangles over more vertices, so that what is made for corners can be stored at vertices: a vertex is copied
 * where the corners that share it have different values (4 floats each, as of cotan_tangents), or where mirrored and
 * unmirrored triangles share it, as cotan_smooth_cotangents wants it. split_indices: index_count, into the new
 * vertices. sources: for each new vertex the old one that it is a copy of, the old ones first; room for vertex_count +
 * index_count. split_count: how many there are. Since version 2. */
cotan_status cotan_split_vertices(size_t vertex_count, size_t index_count, const uint32_t* indices,
                                  const float* corners, uint32_t* split_indices, uint32_t* sources, size_t* split_count,
                                  char* message, size_t message_size);
cotan_status cotan_split_mirrored(const cotan_mesh* mesh, uint32_t* split_indices, uint32_t* sources,
                                  size_t* split_count, char* message, size_t message_size);

/* U and V of the frame "triangle", one pair for each triangle: index_count floats each. Since version 2. */
cotan_status cotan_triangle_vectors(const cotan_mesh* mesh, int threads, float* u, float* v, char* message,
                                    size_t message_size);

/* Small forms of these, which shaders/cotan/triangle.h and pack.h unpack: of `triangle` 3 words each, of `smooth` four
 * SNORM16 or one word each, of tangents (4 floats each) one short each. count: of triangles, or of vertices, whose unit
 * normals are those that unpacking will see. Since version 2. */
cotan_status cotan_pack_triangles(size_t count, const float* u, const float* v, uint32_t* words, char* message,
                                  size_t message_size);
cotan_status cotan_pack_smooth8(size_t count, const float* normals, const float* u, const float* v, int16_t* packed,
                                char* message, size_t message_size);
cotan_status cotan_pack_smooth4(size_t count, const float* normals, const float* u, const float* v, uint32_t* packed,
                                char* message, size_t message_size);
cotan_status cotan_pack_tangents(size_t count, const float* normals, const float* tangents, uint16_t* packed,
                                 char* message, size_t message_size);

/* The triangles over vertices numbered so that vertex k provokes triangle k: a vertex shader that is given k then makes
 * what belongs to the triangle. last: 0 where the first of the three vertices provokes (Vulkan, Direct3D, Metal,
 * WebGPU), else 1 (OpenGL, WebGL). made_indices: index_count, into the new vertices; sources and made_count as above;
 * corners: index_count, into the old vertices, each triangle turned so that the provoking one comes first. Since
 * version 2. */
cotan_status cotan_provoking(size_t vertex_count, size_t index_count, const uint32_t* indices, int last,
                             uint32_t* made_indices, uint32_t* sources, size_t* made_count, uint32_t* corners,
                             char* message, size_t message_size);

/* ---- normal maps ------------------------------------------------------------------------------------------------- */

/* A picture: width * height * 4 components of 8 or 16 bits, or floats (32). At most 65536 a side. */
typedef struct cotan_picture {
    size_t size;
    int width, height;
    int bits;
    void* pixels; /* never null: read where the picture is an input, written where it is an output */
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

/* What the numbers of a picture say about it as a normal map. Shares are 0 to 1. */
typedef struct cotan_map_info {
    size_t size;
    char content[64]; /* a few words, such as "tangent space" or "one value everywhere" */
    int zero;         /* the code of 255 that stands for zero: 128; 127 for 127.5; 0: cannot be told */
    int srgb; /* 1: stored as if it were a colour; -1: as if it had been taken for one when it was read; 0: neither */
    double background;    /* share outside the charts, which the rest leaves out */
    double invalid;       /* share that is no direction */
    double below_horizon; /* share with z below 0 */
    double mean_length;
    double mean_tilt; /* degrees from flat */
    double mean[3];   /* x, y, z, green up */
} cotan_map_info;
cotan_status cotan_map_describe(const cotan_picture* map, cotan_map_info* info, char* message, size_t message_size);

/* The map stored another way. `to_map` has the size of `map` and the bits that are wanted. */
cotan_status cotan_map_convert(const cotan_picture* map, const char* from, const char* to, cotan_picture* to_map,
                               char* message, size_t message_size);

/* The normal map of a height picture, whose red is read; heights repeat over the borders. scale_x, scale_y: slope per
 * unit of stored height and texel. */
cotan_status cotan_map_from_height(const cotan_picture* height, double scale_x, double scale_y, const char* to,
                                   cotan_picture* map, char* message, size_t message_size);

/* The height whose slopes are nearest to the map's, in widths of a texel, mean 0: width * height floats. */
cotan_status cotan_map_to_height(const cotan_picture* map, const char* from, float* heights, char* message,
                                 size_t message_size);

/* A base map with a detail map over it, of the base's size; both and the result are stored as `convention` says.
 * `mode`: "reoriented", "whiteout", "udn", "slopes" or "linear". strength: factor on the detail's slopes. */
cotan_status cotan_map_blend(const cotan_picture* base, const cotan_picture* detail, const char* convention,
                             const char* mode, double strength, cotan_picture* map, char* message, size_t message_size);

/* Levels of half the size each, down to 1 x 1, filtered as vectors. `take` gets each, largest first, with the map and
 * with the roughness (grey) that makes up for what averaging took; both are gone when it returns, and another result
 * than 0 stops (COTAN_STOPPED). roughness: of the material, 0 to 1. */
typedef int (*cotan_take_level)(void* user, int level, const cotan_picture* map, const cotan_picture* roughness);
cotan_status cotan_map_mips(const cotan_picture* map, const char* convention, double roughness, cotan_take_level take,
                            void* user, char* message, size_t message_size);

/* ---- shader text ------------------------------------------------------------------------------------------------- */

/* The function that perturbs the normal with that frame, self-contained, with a zero at its end. `language`: a name
 * that `cotan shader --lang` takes, such as "hlsl"; the text of "godot" is a whole spatial shader. `frame`: its name;
 * for "triangle" a stage may follow, whose part is all that is given then: "triangle,fragment", "triangle,vertex",
 * "triangle,mesh" or "triangle,compute". text_size: of the buffer; afterwards what the text takes. A buffer that is too
 * small, or null, is left alone and is no error. */
cotan_status cotan_shader_text(const char* language, const char* frame, const char* convention, char* text,
                               size_t* text_size, char* message, size_t message_size);

/* ---- models ------------------------------------------------------------------------------------------------------ */

/* A model that the library has read, or that was made of meshes. It is the caller's, who frees it; null is fine. Since
 * version 3. */
typedef struct cotan_model cotan_model;
void cotan_model_free(cotan_model* model);

/* Reads a model file: .glb, .gltf, .obj, and by Assimp .ply, .stl, .dae, .fbx or .3ds: see cotan_set_reader. Missing
 * normals are made. pictures: 0: those of its materials are left out, which is enough to bake by its shape. memory: of
 * the largest picture, in MiB; 0: 640. COTAN_UNAVAILABLE: not built with what reads it. Since version 3. */
cotan_status cotan_model_open(const char* file, int pictures, int memory, cotan_model** model, char* message,
                              size_t message_size);

/* Readers of other people's make may crash on broken files. From here on a child process reads models other than glTF,
 * and pictures other than PNG and JPEG, so that this one goes on with COTAN_INPUT: the program words[0], called with
 * the other words and one more, which has to call cotan_reader_process before it does anything else. The child may
 * neither write files nor start programs (Linux). count 0: they are read in this process, as at first. To be called
 * while no other call is under way. Since version 3. */
cotan_status cotan_set_reader(size_t count, const char* const* words, char* message, size_t message_size);
/* Reads for the process that has started this one, and ends this one. Returns, an exit code, only where none has. Since
 * version 3. */
int cotan_reader_process(void);

/* A model of copies of meshes, whose normals and texcoords may be null; missing normals are smooth ones. names: of the
 * meshes; null, or a null among them: none. Since version 3. */
cotan_status cotan_model_of_meshes(size_t count, const cotan_mesh* const* meshes, const char* const* names,
                                   cotan_model** model, char* message, size_t message_size);

/* Which axis of the model is up: "y", as everything here has it, or "z", as in PLY and STL of Blender and CAD: then it
 * is turned by 90 degrees about x. Once for each model, before it is used; a second "z" turns it further. Since
 * version 5.
 */
cotan_status cotan_model_up(cotan_model* model, const char* up, char* message, size_t message_size);

/* What was odd about it, one line each, "" where nothing was; gone with the model. Since version 3. */
const char* cotan_model_warnings(const cotan_model* model);

/* ---- baking ------------------------------------------------------------------------------------------------------ */

typedef struct cotan_bake_options {
    size_t size;
    const char* frame;       /* that will read the map; null: "mikktspace", which every engine reads */
    const char* kind;        /* "normal", "object-normal", "height" or "occlusion"; null: "normal" */
    const char* convention;  /* of the map; null: "gltf" */
    int samples;             /* a texel and axis: 1, 2 or 4; 0: 1 */
    int padding;             /* texels around charts that are filled; 0: all, -1: none */
    int dither;              /* not 0: maps of 8 bits do not band */
    int occlusion_rays;      /* 0: 64 */
    float max_distance;      /* detail further than this from the simple surface does not count, units of the positions;
                                0: 10 % of the diagonal of the simple surface's box; for the search "nearest" 5 % of
                                that of the detailed one */
    int threads;             /* 0: all cores; the result does not depend on it */
    cotan_progress progress; /* may be null */
    void* user;
    /* Since version 3. */
    const cotan_model* cage;     /* the triangles of the simple model in their order, moved out around both; rays run
                                    from it inwards. null: none */
    int match_by_name;           /* not 0: a simple mesh NAME_low sees the detailed mesh NAME_high only */
    int material;                /* of the simple model, from 1; 0: all */
    int tile;                    /* UDIM number; 0: 1001 */
    const char* tangents;        /* for "mikktspace" and "vertex": "stored" or "generated"; null: "generated" */
    const char* high_normals;    /* "smooth", "curved", "face" or "map" (its own); null: "smooth" */
    const char* high_frame;      /* that its maps were made for; null: "mikktspace" */
    const char* high_convention; /* how they are stored; null: as its materials say, "gltf" for high_maps */
    size_t high_map_count;       /* 0, 1, or one for each detailed model */
    const cotan_picture* const* high_maps; /* that take the place of its own */
    cotan_picture* mask; /* of 8 bits and the map's size: gets what became of each texel; null: not wanted */
    float cage_reach; /* how far rays run from the cage; 0: as far behind the simple model as the cage is before it */
    /* Since version 4. */
    const char* search; /* "first": what a ray from outside inwards meets; "nearest": what is nearest to the simple
                           surface along its normal, either way; null: "first" */
    float extrusion;    /* how far before the simple surface rays start, units of the positions; 0: measured, as the
                           detailed one stands off */
} cotan_bake_options;

typedef struct cotan_bake_result {
    size_t size;
    size_t texels, covered;
    size_t missed;   /* whose ray found nothing */
    size_t negative; /* whose normal lies below the frame's horizon */
    size_t twice;    /* that several triangles cover */
    size_t rays;
    double ray_distance; /* the search distance used */
    /* Since version 4. */
    size_t further;   /* of the missed ones: there is a surface further away than rays look */
    size_t nearer;    /* that show the first surface from outside, where another is nearer */
    double ray_start; /* the largest distance before the simple surface from which rays start */
} cotan_bake_result;

/* The map of the detailed mesh `high`, whose texcoords may be null, for the simple one `low`. `map` has the size and
 * bits that are wanted. options and result may be null. COTAN_UNAVAILABLE: not built with Embree. */
cotan_status cotan_bake(const cotan_mesh* low, const cotan_mesh* high, const cotan_bake_options* options,
                        cotan_picture* map, cotan_bake_result* result, char* message, size_t message_size);

/* The same for models: the map of the detailed ones, all together, for the simple one. `warnings` may be null; it gets
 * text, one line each. Since version 3. */
cotan_status cotan_bake_models(const cotan_model* low, size_t high_count, const cotan_model* const* high,
                               const cotan_bake_options* options, cotan_picture* map, cotan_bake_result* result,
                               cotan_bytes** warnings, char* message, size_t message_size);

/* ---- glTF in memory ---------------------------------------------------------------------------------------------- */

/* How the files and pictures of a model are reached. The functions are called on the caller's thread, one at a time.
 * Each sets a pointer to what it has and returns 0; where there is nothing it returns another number. The library
 * copies what the pointer points to, and then calls `done`. The struct, and each function, may be null. */
typedef struct cotan_model_files {
    size_t size;
    void* user;
    /* A file beside the model by its URI. Without it models that name files are refused. */
    int (*read)(void* user, const char* uri, const void** bytes, size_t* byte_count);
    /* The picture in a PNG or JPEG file: sets all but `size`. Without it: the library's own readers. */
    int (*decode)(void* user, const char* name, const void* bytes, size_t byte_count, cotan_picture* picture);
    /* The PNG file of a picture of 8 or 16 bits. Without it: the library's own writer. */
    int (*encode)(void* user, const cotan_picture* picture, const void** bytes, size_t* byte_count);
    void (*done)(void* user);
    const char* name; /* of the model in messages; null: "model.glb" or "model.gltf". Since version 3 */
} cotan_model_files;

/* Calls `take` for each picture in the model that is decoded to lint it, or, with maps_only, to convert it: what is not
 * known of at once can so be decoded beforehand. bytes: gone when `take` returns. Another result than 0 stops
 * (COTAN_STOPPED). Since version 2. */
typedef int (*cotan_take_file)(void* user, const char* name, const void* bytes, size_t byte_count);
cotan_status cotan_gltf_pictures(const void* model, size_t model_size, const cotan_model_files* files, int maps_only,
                                 cotan_take_file take, void* user, char* message, size_t message_size);

typedef struct cotan_lint_options {
    size_t size;
    double distance;         /* from eye to surface, units of the model; 0: where the whole model fills the picture */
    cotan_progress progress; /* may be null */
    void* user;
    /* What makes it a check, as of `cotan lint`: its verdict is "check" in the report. 0: no limit; 1e-9 allows
     * nothing. Since version 4. */
    double limit;      /* degrees that the error with `frame` may exceed on 5 % of the area */
    double limit_area; /* % of a primitive's area with degenerate or mirrored overlapping uv, or wrong tangents */
    const char* frame; /* cotangent, orthonormal, smooth, exact, triangle or stored; null: "orthonormal" */
} cotan_lint_options;

/* The main figures of a report. Degrees are means over the surface, of the worst of the maps; -1: nothing was judged.
 */
typedef struct cotan_lint_result {
    size_t size;
    size_t primitives, maps;
    char advice[16];        /* the frame to read or make the maps for; empty: nothing has to be changed */
    size_t maps_to_convert; /* that `advice` asks for */
    int distrust_stored;    /* 1: stored tangents contradict the uv */
    size_t green_against;   /* maps whose green points the other way than the model says */
    double orthonormal_degrees, cotangent_degrees, smooth_degrees; /* off, maps for MikkTSpace read as they are */
    char recommendation[1024];                                     /* in sentences, cut where it is longer */
} cotan_lint_result;

/* What to expect of a model (.glb or .gltf as bytes) whose normal maps are read without stored tangents. options,
 * result and json may be null; json: all of the report, as text. */
cotan_status cotan_lint_gltf(const void* model, size_t model_size, const cotan_model_files* files,
                             const cotan_lint_options* options, cotan_lint_result* result, cotan_bytes** json,
                             char* message, size_t message_size);

/* The same of a model that has its pictures, of any format. Since version 3. */
cotan_status cotan_lint_model(const cotan_model* model, const cotan_lint_options* options, cotan_lint_result* result,
                              cotan_bytes** json, char* message, size_t message_size);

typedef struct cotan_convert_options {
    size_t size;
    const char* from; /* frame that the maps were made for; null: the one that the file names, else "mikktspace" */
    const char* to;   /* that they shall be for; null: "cotangent" */
    int bits; /* of the new maps, 8 or 16, and all are written anew; 0: as the old ones, which stay where they fit */
    int keep_tangents;       /* not 0: TANGENT stays where the new frame does not read it */
    int generate_tangents;   /* not 0: for `from`, tangents are generated even where the model has some */
    int threads;             /* 0: all cores; the result does not depend on it */
    cotan_progress progress; /* may be null */
    void* user;
    const char* expansion; /* how engines take the numbers of the maps: "biased" (2c - 1) or "exact"; null: "biased" */
    /* Since version 5. */
    int keep_maps; /* not 0: all maps stay, byte for byte, to be read with `to`, which may not read tangents; only
                      tangents go. `to` null: "orthonormal" then */
} cotan_convert_options;

typedef struct cotan_convert_result {
    size_t size;
    size_t maps_converted, maps_kept;
    size_t primitives_given; /* that have new tangents */
    size_t tangent_bytes_dropped;
    /* How far the normals are off with the new frame: the mean over the surface of a map, of the worst of the maps.
     * -1: nothing was judged. */
    double worst_degrees_before, worst_degrees_after;
} cotan_convert_result;

/* A model's normal maps made for another frame. glb: the new model, with all files of the old one inside. options,
 * result and json may be null. */
cotan_status cotan_convert_gltf(const void* model, size_t model_size, const cotan_model_files* files,
                                const cotan_convert_options* options, cotan_convert_result* result, cotan_bytes** glb,
                                cotan_bytes** json, char* message, size_t message_size);

/* The same in two steps, for callers who cannot encode a picture while they wait: a conversion whose pictures, of 8 or
 * 16 bits, are there to be encoded, and then the model with the PNG files of all of them. files->encode is not called.
 * result and json as above; of json "bytes_after" is known in the second step. Since version 2. */
typedef struct cotan_conversion cotan_conversion;
cotan_status cotan_convert_begin(const void* model, size_t model_size, const cotan_model_files* files,
                                 const cotan_convert_options* options, cotan_convert_result* result,
                                 cotan_conversion** conversion, char* message, size_t message_size);
size_t cotan_conversion_count(const cotan_conversion* conversion);
cotan_status cotan_conversion_picture(const cotan_conversion* conversion, size_t number, cotan_picture* picture,
                                      char* message, size_t message_size);
cotan_status cotan_conversion_set(cotan_conversion* conversion, size_t number, const void* png, size_t png_size,
                                  char* message, size_t message_size);
cotan_status cotan_convert_end(cotan_conversion* conversion, cotan_bytes** glb, cotan_bytes** json, char* message,
                               size_t message_size);
void cotan_conversion_free(cotan_conversion* conversion); /* null is fine */

/* ---- pictures ---------------------------------------------------------------------------------------------------- */

/* A picture that the library has made. It is the caller's, who frees it; null is fine. Since version 3. */
typedef struct cotan_image cotan_image;
void cotan_image_free(cotan_image* image);
/* Its size, bits and pixels, which are gone with it. */
cotan_status cotan_image_picture(const cotan_image* image, cotan_picture* picture, char* message, size_t message_size);

/* A picture file as it is stored: .png, .jpg, .webp, .ktx2, .dds, and with OpenImageIO .exr, .tif, .tga, .hdr and more.
 * memory: that it may take, in MiB; 0: 640. Since version 3. */
cotan_status cotan_image_read(const char* file, int memory, cotan_image** image, char* message, size_t message_size);

/* Writes a picture file, whole or not at all: .png, and with OpenImageIO .exr, .tif, .tga, .jpg and .hdr. Since version
 * 3. */
cotan_status cotan_image_write(const char* file, const cotan_picture* picture, char* message, size_t message_size);

typedef struct cotan_render_options {
    size_t size;
    size_t word_count;
    const char* const* words; /* of the command line of `cotan render`: "--size", "640x360", "--frame", "smooth" */
    int floats;               /* not 0: as in a file that keeps floats, with light linear and unlimited */
    int threads;              /* 0: all cores; the picture does not depend on it */
    cotan_progress progress;  /* may be null */
    void* user;
} cotan_render_options;

/* The picture that `cotan render` draws for these words, -o and what else is about files left out. model: bytes of a
 * .glb or .gltf; null: the file that the words name, or the built-in scene. options, files and json may be null;
 * json: what was drawn, on which device, and warnings. Since version 3. */
cotan_status cotan_render(const void* model, size_t model_size, const cotan_model_files* files,
                          const cotan_render_options* options, cotan_image** image, cotan_bytes** json, char* message,
                          size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
