// Conventions that every file of Skyshaft keeps. Comments only; include it nowhere.
//
// Units      SI inside: metres, radians, seconds. Degrees appear only at the edges (command line, files) and
//            the name says so: `heading_deg`. A float that crosses a file carries its unit in its name.
// World      Local East-North-Up, right-handed: x east, y north, z up. Origin where the scene file says.
// Azimuth    From true north, clockwise: north 0, east pi/2. Elevation: up from the horizon.
//            direction_in_world = (sin az cos el, cos az cos el, sin el).
// Sun        `sun direction` points from the ground towards the sun. Elevation is geometric (airless) unless the
//            name says `apparent` (lifted by refraction).
// Camera     OpenCV's: x right, y down, z forward. `ar` counts pixels as OpenCV does (centre of the first pixel is
//            0.0); GL and `render` count from the pixel's edge (centre of the first pixel is 0.5). The conversion is
//            render::edge_from_centre_px() / centre_from_edge_px() in render/scene/scene_state.h.
// Pictures   Row 0 is the top row, in memory and in every API of ours. GL textures keep that order (row 0 at v = 0).
// Tag        AprilTag 3's frame: origin at the centre, x right, y down, z into the tag; size = outer edge of the black
//            border (of the white one for the inverted families). Corners in the library's order: left-bottom,
//            right-bottom, right-top, left-top, i.e. (-s,+s), (+s,+s), (+s,-s), (-s,-s) with s = size / 2.
// glTF       +Y up enters the world as (x, -z, y): a model's up is the world's up, its -z faces north at
//            heading 0. A positive heading turns the model clockwise seen from above.
// Transforms `b_from_a`, read right to left: x_in_b = b_from_a * x_in_a. Points are `x_in_a`. No bare T, R or mat.
// Light      Scene-referred linear RGB, Rec. 709 primaries, D65 white, scaled so that the Rec. 709 luminance
//            0.2126 R + 0.7152 G + 0.0722 B is in cd/m2 (`luminance_rgb`) or in lux (`illuminance_rgb`).
// Exposure   `exposure` multiplies luminance_rgb into display-linear values in which 1.0 is the white of the picture.
// Time       std::chrono::sys_time, UTC.
