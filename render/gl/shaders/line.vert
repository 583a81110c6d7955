layout(location = 0) in vec3 positionView;
layout(location = 1) in vec3 colorIn;
uniform mat4 clipFromView;
flat out vec3 color;

void main() {
    gl_Position = clipFromView * vec4(positionView, 1.0);
    color = colorIn;
}
