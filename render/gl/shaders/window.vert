// One triangle over the whole window, made of the vertex's number alone.
out vec2 windowPosition;
#ifdef SKYBOX
uniform mat3 worldFromView;
uniform vec2 tangents;  // of half the field of view, across and up
// Carried to the fragments: see common.glsl.
flat out mat3 skyFromView;
flat out vec2 skyTangents;
#endif

void main() {
#ifdef SKYBOX
    skyFromView = worldFromView;
    skyTangents = tangents;
#endif
    windowPosition = vec2((gl_VertexID & 1) * 4.0 - 1.0, (gl_VertexID & 2) * 2.0 - 1.0);
    gl_Position = vec4(windowPosition, 0.0, 1.0);
}
