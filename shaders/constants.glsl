// Specialisation constants. COTAN_FRAME is a number of the table src/core/include/cotan/frames.inc, OUTPUT and SHADING
// are values of the enums in cotan/view.hpp.
layout(constant_id = 0) const int COTAN_FRAME = 0;
layout(constant_id = 1) const int OUTPUT = 0;
layout(constant_id = 2) const int SHADING = 0;
layout(constant_id = 3) const int ALPHA_MODE = 0;
layout(constant_id = 4) const bool NORMAL_MAPS = true;
layout(constant_id = 5) const bool ENVIRONMENT = true;
layout(constant_id = 6) const bool SHADOWS = true;
layout(constant_id = 7) const bool TONE_MAP = true;
// The maps and layers that the material may have: COTAN_MAP_... and COTAN_LAYER_... of gpu_structs.glsl. CPU drivers
// execute both sides of a branch, so only a map whose bit is cleared here costs no reads.
layout(constant_id = 8) const uint MAPS = 0xffffffffu;
layout(constant_id = 9) const int TONE = COTAN_TONE_ACES; // if TONE_MAP
layout(constant_id = 10) const bool ENVIRONMENT_MAP = false; // if ENVIRONMENT: map instead of formula
layout(constant_id = 11) const bool SOFT_SHADOWS = false; // if SHADOWS
layout(constant_id = 12) const int BACKDROP = 0;
layout(constant_id = 13) const bool GROUND = false;
layout(constant_id = 14) const bool FOUR_SAMPLES = false; // per pixel
layout(constant_id = 15) const bool SPECULAR_ANTIALIASING = false;
layout(constant_id = 16) const bool LEVELS = false; // see levels.glsl
// Distance between adjacent samples in pixels. Texture footprints are scaled by it.
layout(constant_id = 17) const float APART = 1.0;

#define OUTPUT_SHADED 0
#define OUTPUT_NORMAL 1
#define OUTPUT_TANGENT 2
#define OUTPUT_BITANGENT 3
#define OUTPUT_UV 4
#define OUTPUT_DEPTH 5
#define SHADING_PBR 0
#define SHADING_BLINN_PHONG 1
#define ALPHA_OPAQUE 0
#define ALPHA_MASK 1
#define ALPHA_BLEND 2

// The colour to write for linear radiance: exposed, and tone mapped if TONE_MAP; black if it is not finite.
vec3 outputColor(vec3 linear)
{
    vec3 exposed = linear * view.tone.x;
    bool finite = abs(exposed.x) + abs(exposed.y) + abs(exposed.z) <= COTAN_HUGE;
    exposed = finite ? max(exposed, vec3(0.0)) : vec3(0.0);
    return TONE_MAP ? cotan_tone_of(TONE, min(exposed, vec3(1e4))) : exposed;
}
