// The rest of a pixel shader that calls every function of the portable text.
float4 main(float3 n : TEXCOORD0, float3 p : TEXCOORD1, float2 uv : TEXCOORD2) : SV_Target
{
    cotan_normal_format format;
    format.expansion = 0;
    format.channels = 1;
    format.green = -1.0;
    format.strength = 1.0;
    float3 m = cotan_decode(float3(uv, 1.0), format);
    float3 sum = float3(0.0, 0.0, 0.0);
    sum += cotan_apply(cotan_frame_cotangent(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_cotangent_2013(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_nonperspective(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_paper_full(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_paper_nodet(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_paper_transpose(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_paper_orthogonal(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_unit(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_orthonormal(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_gradient(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_exact(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), m);
    sum += cotan_apply(cotan_frame_smooth(n, p, m), m);
    sum += cotan_apply(cotan_frame_vertex(n, p, 1.0), m);
    sum += cotan_apply(cotan_frame_mikktspace(n, p, 1.0), m);
    sum += cotan_perturb_cotangent(n, ddx(p), ddy(p), ddx(uv), ddy(uv), m);
    sum += cotan_perturb_cotangent_area(n, ddx(p), ddy(p), ddx(uv), ddy(uv), m);
    sum += cotan_perturb_gradient(n, ddx(p), ddy(p), ddx(uv), ddy(uv), m);
    sum += cotan_perturb_orthonormal(n, ddx(p), ddy(p), ddx(uv), ddy(uv), m);
    sum += cotan_encode(cotan_frame_cotangent(n, ddx(p), ddy(p), ddx(uv), ddy(uv)), sum);
    sum += cotan_encode_texel(m, format);
    cotan_surface s;
    s.base_color = m;
    s.metallic = 0.5;
    s.roughness = 0.5;
    s.occlusion = 1.0;
    s.emissive = m;
    s.n = n;
    s.v = p;
    sum += cotan_reflect_pbr(s, p) + cotan_reflect_blinn_phong(s, p) + cotan_reflect_environment(s);
    sum = cotan_tone_map(sum * cotan_light_falloff(uv.x, uv.y));
    sum.x = cotan_linear_to_srgb(sum.x) + cotan_srgb_to_linear(sum.y);
    return float4(sum, 1.0);
}
