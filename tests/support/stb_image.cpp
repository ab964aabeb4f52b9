// The functions of stb_image.h. Some distributions have them in a library, others have the header
// alone.
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
