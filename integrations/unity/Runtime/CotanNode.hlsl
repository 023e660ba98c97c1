// The node Cotan > Normal Map of Shader Graph, which Unity 6.5 and later make of this file.
#include "ShaderApiReflectionSupport.hlsl"
#include "Packages/com.cotan.normal-maps/Runtime/Cotan.hlsl"

///<funchints>
///    <sg:ProviderKey>Cotan.NormalMap</sg:ProviderKey>
///    <sg:DisplayName>Cotan Normal Map</sg:DisplayName>
///    <sg:SearchCategory>Cotan</sg:SearchCategory>
///    <sg:SearchName>Normal Map</sg:SearchName>
///    <sg:SearchTerms>tangent, bump, cotangent, derivative</sg:SearchTerms>
///    <sg:ReturnDisplayName>Normal (World)</sg:ReturnDisplayName>
///</funchints>
///<paramhints name = "normal">
///    <sg:DisplayName>Normal (World)</sg:DisplayName>
///    <sg:Default>0, 0, 1</sg:Default>
///</paramhints>
///<paramhints name = "position">
///    <sg:DisplayName>Position (from the camera)</sg:DisplayName>
///</paramhints>
///<paramhints name = "uv">
///    <sg:DisplayName>UV</sg:DisplayName>
///</paramhints>
///<paramhints name = "texel">
///    <sg:DisplayName>Texel</sg:DisplayName>
///    <sg:Default>0, 0, 1</sg:Default>
///</paramhints>
UNITY_EXPORT_REFLECTION
float3 CotanNormalMap(float3 normal, float3 position, float2 uv, float3 texel)
{
    return cotan_perturb_normal(normal, position, uv, texel);
}
