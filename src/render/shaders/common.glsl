// Shared by all fragment shaders.
