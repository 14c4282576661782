// Volumes write no colour.
#version 450
void main() {}
