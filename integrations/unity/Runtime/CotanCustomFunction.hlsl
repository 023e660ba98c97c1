// The source of a Custom Function node of Shader Graph: Type File, Name Cotan, precision Single.
#include "Packages/com.cotan.normal-maps/Runtime/Cotan.hlsl"

void Cotan_float(float3 normal, float3 position, float2 uv, float3 texel, out float3 perturbed)
{
    perturbed = cotan_perturb_normal(normal, position, uv, texel);
}
