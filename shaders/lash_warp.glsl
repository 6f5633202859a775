// Eyes with lashes: what hangs before the pupil changes with the direction of a light, because lashes stand about a
// centimetre before the eye. The pattern is one for all lights; its lookup is turned and bent by the light's place in the
// picture. Both keep areas: a turn, and a shear v -> v + bend u^2 along u, the way that streaks of hanging lashes run. So
// the light is all there. What the lens and the particles make of it is turned along: their rings do not show it.
uniform float lash_turn;  // radians, at most, to either side; 0 and 0: no lashes
uniform float lash_bend;  // of a streak: its offset is bend times its angle squared

// Smooth over the picture, and the same on both sides of it, value and slope: channels that abut show no jump.
vec3 lash_warp_of(vec3 direction) {
    if (lash_turn == 0.0 && lash_bend == 0.0) return vec3(1.0, 0.0, 0.0);
    vec3 plane = inverse(ray_from_ndc) * direction;
    vec2 place = plane.z > 1e-6 ? clamp(plane.xy / plane.z, -1.0, 1.0) : vec2(1.0);
    vec2 wave = sin(3.14159265 * place);
    float turn = lash_turn * wave.x;
    return vec3(cos(turn), sin(turn), lash_bend * (1.0 + 0.5 * wave.y));
}
