// Where in its pattern an offset from a light is looked up: `warp` from lash_warp.glsl. Needs geometry.glsl.
vec2 lash_lookup(vec2 offset_nodes, vec3 warp) {
    if (warp.yz == vec2(0.0)) return offset_nodes;
    vec2 at = vec2(warp.x * offset_nodes.x + warp.y * offset_nodes.y, warp.x * offset_nodes.y - warp.y * offset_nodes.x);
    at.y -= warp.z * pitch * at.x * at.x;
    return at;
}
