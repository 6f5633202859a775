// A grid from the one above it, whose cells are twice as wide: cubics through four nodes, first along one axis and then
// along the other.
uniform sampler2D above;
uniform int pad;            // nodes of this grid before the picture; the one above has two
uniform int bottom;         // the grid's row that the buffer's first is
out vec4 glare;

const vec4 between = vec4(-0.0625, 0.5625, 0.5625, -0.0625);

vec4 row_at(ivec2 at, int odd) {
    vec4 node = texelFetch(above, at, 0);
    if (odd == 0) return node;
    return between.y * (node + texelFetch(above, at + ivec2(1, 0), 0)) +
           between.x * (texelFetch(above, at - ivec2(1, 0), 0) + texelFetch(above, at + ivec2(2, 0), 0));
}

void main() {
    // Never negative, and as odd as the offset from the picture's first pixel.
    ivec2 node = ivec2(gl_FragCoord.xy) + ivec2(0, bottom) - pad + 4;
    ivec2 at = node >> 1;
    int odd = node.x & 1;
    vec4 value = row_at(at, odd);
    if ((node.y & 1) == 1) {
        value = between.y * (value + row_at(at + ivec2(0, 1), odd)) +
                between.x * (row_at(at - ivec2(0, 1), odd) + row_at(at + ivec2(0, 2), odd));
    }
    glare = value;
}
