import type { Image, InterpolatedPoints, SurfacePoints, decodeImage } from './cotan.js';

/** @deprecated Image */
export type Picture = Image;
/** @deprecated SurfacePoints */
export type Places = SurfacePoints;
/** @deprecated InterpolatedPoints */
export type VertexPlaces = InterpolatedPoints;
/** @deprecated decodeImage */
export const decodePicture: typeof decodeImage;
