// A normal map without tangents, lit by the main light. For the Universal Render Pipeline.
Shader "Cotan/Normal Map"
{
    Properties
    {
        _BaseColor("Color", Color) = (1, 1, 1, 1)
        [Normal] _NormalMap("Normal Map", 2D) = "bump" {}
    }
    SubShader
    {
        Tags { "RenderType" = "Opaque" "RenderPipeline" = "UniversalPipeline" }
        Pass
        {
            HLSLPROGRAM
            #pragma target 3.5
            #pragma vertex vert
            #pragma fragment frag
            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"
            #include "Packages/com.cotan.normal-maps/Runtime/Cotan.hlsl"

            TEXTURE2D(_NormalMap);
            SAMPLER(sampler_NormalMap);
            CBUFFER_START(UnityPerMaterial)
            float4 _BaseColor;
            float4 _NormalMap_ST;
            CBUFFER_END

            struct Attributes
            {
                float4 position : POSITION;
                float3 normal : NORMAL;
                float2 uv : TEXCOORD0;
            };

            struct Varyings
            {
                float4 clip : SV_POSITION;
                float3 position : TEXCOORD0; // from the camera
                float3 normal : TEXCOORD1;
                float2 uv : TEXCOORD2;
            };

            Varyings vert(Attributes input)
            {
                Varyings output;
                float3 world = TransformObjectToWorld(input.position.xyz);
                output.clip = TransformWorldToHClip(world);
                output.position = world - GetCameraPositionWS();
                output.normal = TransformObjectToWorldNormal(input.normal);
                output.uv = TRANSFORM_TEX(input.uv, _NormalMap);
                return output;
            }

            float4 frag(Varyings input) : SV_Target
            {
                float3 texel = UnpackNormal(SAMPLE_TEXTURE2D(_NormalMap, sampler_NormalMap, input.uv));
                float3 normal = cotan_perturb_normal(input.normal, input.position, input.uv, texel);
                Light light = GetMainLight();
                return float4(_BaseColor.rgb * light.color * saturate(dot(normal, light.direction)), 1.0);
            }
            ENDHLSL
        }
    }
}
