// One triangle over the whole window, made of the vertex's number alone.
out vec2 windowPosition;

void main() {
    windowPosition = vec2((gl_VertexID & 1) * 4.0 - 1.0, (gl_VertexID & 2) * 2.0 - 1.0);
    gl_Position = vec4(windowPosition, 0.0, 1.0);
}
