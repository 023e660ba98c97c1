// The rest of a fragment shader that calls every function of the portable text.
layout(location = 0) in vec3 n;
layout(location = 1) in vec3 p;
layout(location = 2) in vec2 uv;
layout(location = 0) out vec4 color;

void main()
{
    cotan_normal_format format = cotan_normal_format(0, 1, -1.0, 1.0);
    vec3 m = cotan_decode(vec3(uv, 1.0), format);
    vec3 sum = vec3(0.0);
    sum += cotan_apply(cotan_frame_cotangent(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_cotangent_2013(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_nonperspective(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_paper_full(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_paper_nodet(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_paper_transpose(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_paper_orthogonal(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_unit(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_orthonormal(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_gradient(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_exact(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), m);
    sum += cotan_apply(cotan_frame_smooth(n, p, m), m);
    sum += cotan_apply(cotan_frame_vertex(n, p, 1.0), m);
    sum += cotan_apply(cotan_frame_mikktspace(n, p, 1.0), m);
    sum += cotan_perturb_cotangent(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv), m);
    sum += cotan_perturb_cotangent_area(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv), m);
    sum += cotan_perturb_gradient(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv), m);
    sum += cotan_perturb_orthonormal(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv), m);
    sum += cotan_encode(cotan_frame_cotangent(n, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv)), sum);
    sum += cotan_encode_texel(m, format);
    vec2 slope = cotan_slope_of_texel(m);
    vec3 g = cotan_gradient_of_slope(cotan_frame_smooth(n, p, m), slope);
    g += cotan_gradient_of_normal(n, m) + cotan_gradient_of_volume(n, p);
    g += cotan_gradient_of_height(n, p, m, uv.x, uv.y);
    g += cotan_gradient_triplanar(n, cotan_triplanar_weights(n), slope, uv, slope);
    sum += cotan_resolve_gradient(n, g);
    sum += cotan_blend_reoriented(m, n) + cotan_blend_whiteout(m, n) + cotan_blend_udn(m, n);
    sum += cotan_blend_slopes(m, n, 1.0, 0.5) + cotan_blend_linear(m, n);
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
    color = vec4(sum, 1.0);
}
