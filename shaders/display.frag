#version 330 core
// The display transform from radiance to sRGB. core/image/display.cpp implements the same transform for files.
uniform sampler2D radiance;
uniform float scale;              // 2^exposure
uniform int curve;                // tone mapping: 0 none, 1 Khronos PBR Neutral, 2 ACES, 3 AgX
uniform bool false_color;         // show the luminance in false colours, on a logarithmic scale
uniform vec2 false_color_range;   // log2 of the luminance at both ends of the palette
uniform vec3 palette[9];          // sRGB colours, evenly spaced
out vec4 color;

// Khronos PBR Neutral.
vec3 neutral(vec3 c) {
  const float start = 0.8 - 0.04, desaturation = 0.15, range = 1.0 - start;
  float minimum = min(c.r, min(c.g, c.b));
  c -= minimum < 0.08 ? minimum - 6.25 * minimum * minimum : 0.04;
  float peak = max(c.r, max(c.g, c.b));
  if (peak < start) return c;
  float compressed = 1.0 - range * range / (peak + range - start);
  c *= compressed / peak;
  return mix(c, vec3(compressed), 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0));
}

// ACES: fit of the reference rendering transform and the output transform by S. Hill. Matrices are written row by row
// and transposed.
vec3 aces(vec3 c) {
  const mat3 into = mat3(0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840, 0.13383, 0.83777);
  const mat3 outof = mat3(1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602);
  vec3 v = transpose(into) * (c / 0.6);
  v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  return transpose(outof) * v;
}

// AgX by T. Sobotka, in the fit by B. Wrensch.
vec3 agx(vec3 c) {
  const mat3 into = mat3(0.842479062253094, 0.0784335999999992, 0.0792237451477643,
                         0.0423282422610123, 0.878468636469772, 0.0791661274605434,
                         0.0423756549057051, 0.0784336, 0.879142973793104);
  const mat3 outof = mat3(1.19687900512017, -0.0980208811401368, -0.0990297440797205,
                          -0.0528968517574562, 1.15190312990417, -0.0989611768448433,
                          -0.0529716355144438, -0.0980434501171241, 1.15107367264116);
  const float min_ev = -12.47393, max_ev = 4.026069;
  vec3 x = clamp((log2(max(transpose(into) * c, 1e-10)) - min_ev) / (max_ev - min_ev), 0.0, 1.0);
  vec3 x2 = x * x, x4 = x2 * x2;
  x = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
  return pow(max(transpose(outof) * x, 0.0), vec3(2.2));
}

vec3 srgb_encoded(vec3 c) { return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308))); }

vec3 palette_color(float x) {
  float at = clamp(x, 0.0, 1.0) * 8.0;
  int cell = min(int(at), 7);
  return mix(palette[cell], palette[cell + 1], at - float(cell));
}

void main() {
  vec3 c = texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb;
  // NaN is shown as black, as in files.
  c = vec3(c.r > 0.0 ? min(c.r, 1e12) : 0.0, c.g > 0.0 ? min(c.g, 1e12) : 0.0, c.b > 0.0 ? min(c.b, 1e12) : 0.0);
  if (false_color) {
    float y = dot(c, vec3(0.212671, 0.715160, 0.072169));
    color = vec4(palette_color((log2(max(y, 1e-30)) - false_color_range.x) / (false_color_range.y - false_color_range.x)), 1.0);
    return;
  }
  c *= scale;
  if (curve == 1) c = neutral(c);
  if (curve == 2) c = aces(c);
  if (curve == 3) c = agx(c);
  color = vec4(srgb_encoded(clamp(c, 0.0, 1.0)), 1.0);
}
