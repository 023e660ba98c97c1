/* The names that version 9 of cotan.h replaced. Programs written for older versions compile with them, once more: the
 * next version deletes this file. Define COTAN_NO_OLD_NAMES to find the lines that still use them. */
#ifndef COTAN_OLD_NAMES_H
#define COTAN_OLD_NAMES_H

#define cotan_picture cotan_image_view
#define cotan_places cotan_surface_points
#define cotan_vertex_places cotan_interpolated_points
#define cotan_gltf_pictures cotan_gltf_images
#define cotan_conversion_picture cotan_conversion_image
#define cotan_image_picture cotan_image_pixels

#endif
