// Boxes of the viewport, each two triangles.
uniform vec4 boxes[64];  // left, bottom, right, top in normalised device coordinates

void main() {
    vec4 box = boxes[gl_VertexID / 6];
    // Left below, right below, left above; left above, right below, right above.
    int corner = gl_VertexID % 6;
    bool right = corner == 1 || corner > 3;
    bool above = corner == 2 || corner == 3 || corner == 5;
    gl_Position = vec4(right ? box.z : box.x, above ? box.w : box.y, 0.0, 1.0);
}
