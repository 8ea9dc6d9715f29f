#version 310 es
// Real things leave their depth and nothing else.
void main() {}
