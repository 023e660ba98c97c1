// Cotan portable text: blending two texels of the same uv. Include lang.h and frame.h first.
//
// base and detail are decoded, unit and above the horizon (z > 0) unless a function says otherwise; results are unit.
// Do not blend maps over different uv sets this way; add their gradients instead (gradient.h).
//
// Sources: C. Barre-Brisebois, S. Hill, Blending in Detail, 2012, cited as [2012].

#ifndef COTAN_BLEND_H
#define COTAN_BLEND_H

// Reoriented: rotates the detail by the shortest rotation that takes (0,0,1) to the base. Keeps the full slope of both.
// base.z is clamped to at least -0.999.
// Source: [2012] 'Reoriented Normal Mapping'.
COTAN_FUNCTION cotan_vec3 cotan_blend_reoriented(cotan_vec3 base, cotan_vec3 detail)
{
    cotan_vec3 t = cotan_vec3(base.x, base.y, max(base.z, cotan_real(-0.999)) + cotan_real(1.0));
    cotan_vec3 u = cotan_vec3(-detail.x, -detail.y, detail.z);
    return cotan_normalize_or(t * (dot(t, u) / t.z) - u, base);
}

// Whiteout: adds x and y, multiplies z. Source: [2012].
COTAN_FUNCTION cotan_vec3 cotan_blend_whiteout(cotan_vec3 base, cotan_vec3 detail)
{
    return cotan_normalize_or(
        cotan_vec3(base.x + detail.x, base.y + detail.y, base.z * detail.z), base);
}

// UDN: adds x and y, keeps the base's z; flattens the detail on steep bases. Source: [2012].
COTAN_FUNCTION cotan_vec3 cotan_blend_udn(cotan_vec3 base, cotan_vec3 detail)
{
    return cotan_normalize_or(cotan_vec3(base.x + detail.x, base.y + detail.y, base.z), base);
}

// Adds the slopes, each with a weight, as if the heights were added. Weights of 1 give the partial-derivative blend;
// weights that sum to 1 cross-fade. A texel with z = 0 gives a horizontal result.
// Source: [2012] 'Partial Derivative'.
COTAN_FUNCTION cotan_vec3 cotan_blend_slopes(
    cotan_vec3 base, cotan_vec3 detail, cotan_real base_weight, cotan_real detail_weight)
{
    cotan_real b = base_weight * detail.z;
    cotan_real d = detail_weight * base.z;
    return cotan_normalize_or(
        cotan_vec3(base.x * b + detail.x * d, base.y * b + detail.y * d, base.z * detail.z), base);
}

// Linear: the normalised sum, for comparison; it flattens both. Opposite texels give the base.
COTAN_FUNCTION cotan_vec3 cotan_blend_linear(cotan_vec3 base, cotan_vec3 detail)
{
    return cotan_normalize_or(base + detail, base);
}

#endif
