# Saves a picture of the add-on's example: godot -s res://picture.gd -- FILE.bin, raw RGB of 960 x 480, and FILE.bin.png
extends SceneTree


func _initialize() -> void:
	change_scene_to_file("res://addons/cotan/example/example.tscn")
	for frame in 4:
		await RenderingServer.frame_post_draw
	var image := root.get_texture().get_image()
	image.convert(Image.FORMAT_RGB8)
	var file: String = OS.get_cmdline_user_args()[0]
	FileAccess.open(file, FileAccess.WRITE).store_buffer(image.get_data())
	image.save_png(file + ".png")
	quit()
