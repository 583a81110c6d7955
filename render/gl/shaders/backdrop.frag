in vec2 windowPosition;
out vec4 result;

#ifdef SKYBOX
uniform samplerCube sky;
uniform mat3 worldFromView;
uniform vec2 tangents;  // of half the field of view, across and up

void main() {
    vec3 ray = worldFromView * vec3(windowPosition * tangents, -1.0);
    // Cube maps are left-handed.
    result = vec4(texture(sky, vec3(ray.xy, -ray.z)).rgb, 1.0);
}
#else
uniform sampler2D image;

void main() { result = vec4(texture(image, windowPosition * 0.5 + 0.5).rgb, 1.0); }
#endif
