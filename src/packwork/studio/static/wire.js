// @ts-check
/**
 * What page and studio say to each other.
 *
 * Written by ``tools/write_wire.py`` from the schema; nothing here is run.
 *
 * @typedef {{type: "ack", frame: number}} Ack
 * @typedef {{kind: "add", asset: string, x: number, y: number, area: number, angle?: number, weight?: (number | null)}} Add
 * @typedef {{kind: "align", items: number[], to: ("left" | "center" | "right" | "top" | "middle" | "bottom")}} Align
 * @typedef {{type: "alike", source: string}} Alike
 * @typedef {{kind: "arrange", items: number[], poses: [number, number, number, number][]}} Arrange
 * @typedef {{kind: "background", colour?: string, asset?: (string | null)}} Background
 * @typedef {{type: "begin", template?: (("icons" | "letters" | "words" | "names" | "badge" | "paper" | "jar" | "nest" | "photos" | "mosaic") | null), source?: (string | null), kept?: (string | null)}} Begin
 * @typedef {{type: "chart", source: string, size_by?: (string | null), color_by?: (string | null), label_by?: (string | null), by?: (string | null), in_regions?: boolean, by_step?: (number | null), mark?: (string | null), title?: string}} BeginChart
 * @typedef {{type: "bring", sources: string[], x?: (number | null), y?: (number | null)}} Bring
 * @typedef {{kind: "cancel"}} Cancel
 * @typedef {{type: "copy", items: number[], token: string}} Copy
 * @typedef {{type: "count", count: number}} Count
 * @typedef {{kind: "cover", share: number}} Cover
 * @typedef {{kind: "crop", item: number, zoom: number, x?: number, y?: number}} CropPhoto
 * @typedef {{kind: "distribute", items: number[], direction: ("horizontal" | "vertical")}} Distribute
 * @typedef {{type: "do", n: number, command: (Move | Turn | Scale | Exchange | Cover | Arrange | Align | Distribute | Hold | Release | Add | Duplicate | Remove | Replace | Weigh | Rename | Recolour | Flip | Group | Ungroup | SetContainer | Reshape | PlaceContainer | SetOption | Entitle | LeaveOut | Paint | SetMosaic | CropPhoto | Background | SetHalos | DrawContainer | SetLines | Together | Grab | Drop | Cancel)}} Do
 * @typedef {{kind: "draw_container", line: [number, number][], is_hole?: boolean}} DrawContainer
 * @typedef {{path: string, matrix: [number, number, number, number, number, number], fill: string, item: (number | null), pose: [number, number, number, number]}} DrawnNote
 * @typedef {{kind: "drop"}} Drop
 * @typedef {{kind: "duplicate", item: number, beside?: number}} Duplicate
 * @typedef {{kind: "entitle", title: string}} Entitle
 * @typedef {{kind: "exchange", first: number, second: number}} Exchange
 * @typedef {{type: "fill", use: ("items" | "words" | "photos"), source: string, count?: (number | null), font?: (string | null), palette?: (string | null), without?: string[], along?: (("limbs" | "edge") | null), ring?: string[]}} Fill
 * @typedef {{kind: "flip", items: number[], direction?: ("horizontal" | "vertical")}} Flip
 * @typedef {{kind: "grab", items: number[]}} Grab
 * @typedef {{kind: "group", items: number[]}} Group
 * @typedef {{kind: "hold", items: number[], properties?: ("place" | "angle" | "size")[]}} Hold
 * @typedef {{type: "leap", n: number, to: ("undo" | "redo")}} LeapMessage
 * @typedef {{kind: "leave_out", words: any}} LeaveOut
 * @typedef {{name: string, reason: string}} LeftOut
 * @typedef {{type: "line", text: string, is_error?: boolean}} Line
 * @typedef {{type: "lines", along?: (("limbs" | "edge") | null), ring?: string[], font?: (string | null)}} Lines
 * @typedef {{type: "mix", share: number, source?: (string | null), count?: (number | null), font?: (string | null), palette?: (string | null)}} Mix
 * @typedef {{type: "more", seed: number}} More
 * @typedef {{kind: "move", item: number, x: number, y: number}} Move
 * @typedef {{type: "open", source: string}} Open
 * @typedef {{type: "order", way: ("right" | "left" | "down" | "up" | "outwards" | "inwards" | "around" | "along"), by: ("weight" | "hue" | "lightness" | "name")}} Order
 * @typedef {{type: "outline", line: [number, number][]}} OutlineMessage
 * @typedef {{kind: "paint", palette: string[], shades?: ("tint" | "nearest" | "keep")}} Paint
 * @typedef {{type: "paste", x?: (number | null), y?: (number | null)}} Paste
 * @typedef {{type: "picture", source: string, purpose?: ("mosaic" | "colours" | "behind")}} Picture
 * @typedef {{kind: "place_container", x?: number, y?: number, factor?: number, angle?: number}} PlaceContainer
 * @typedef {{type: "pour", seed: number}} Pour
 * @typedef {{kind: "recolour", items: number[], colour: string}} Recolour
 * @typedef {{kind: "release", items: number[], properties?: ("place" | "angle" | "size")[]}} Release
 * @typedef {{kind: "remove", items: number[]}} Remove
 * @typedef {{kind: "rename", item: number, name: string}} Rename
 * @typedef {{kind: "replace", item: number, asset: string}} Replace
 * @typedef {{kind: "reshape", rings: [number, number][][]}} Reshape
 * @typedef {{type: "room", source: string, font?: (string | null), canvas?: (string | null), tile?: (("square" | "half-drop" | "hexagon") | null), names?: boolean}} Room
 * @typedef {Line | Scene | Shapes | State | Variant} Said
 * @typedef {{kind: "scale", item: number, factor: number}} Scale
 * @typedef {{type: "scene", version: number, name: string, outline: string, is_lined: boolean, width: number, height: number, unit: string, items: Thing[], options: any, angles?: (number[] | null), kind?: ("collage" | "nest" | "chart" | "pile" | "tile" | "lines"), notes?: DrawnNote[], title?: string, palette?: string[], shades?: string, ground?: string, gradient?: string, font?: string, left_out?: any, likeness?: (number | null), halos?: string, along?: (("limbs" | "edge") | null), ring?: string[], repeat?: ([number, number, number] | null), rim?: number, under?: Underlay[]}} Scene
 * @typedef {{type: "set", options: any}} Set
 * @typedef {{kind: "set_container", asset: string}} SetContainer
 * @typedef {{kind: "halos", choice: ("none" | "faint" | "all")}} SetHalos
 * @typedef {{kind: "lines", along?: (("limbs" | "edge") | null), ring?: string[], palette?: (string | null), areas_in_shares?: (boolean | null)}} SetLines
 * @typedef {{kind: "mosaic", asset?: (string | null), tint?: (number | null)}} SetMosaic
 * @typedef {{kind: "set_option", name: string, value: (number | string | string[])}} SetOption
 * @typedef {{key: string, outline: string, size: [number, number], box: [number, number, number, number], fill: string, ink: string, svg: string, whole: string}} Shape
 * @typedef {{type: "shapes", shapes?: Shape[], gone?: string[]}} Shapes
 * @typedef {{type: "state", covered: number, moving: boolean, certified: boolean, in_the_way: string[], entangled: number[], unplaced: LeftOut[], advice: string[], unmet: any, can_undo: boolean, can_redo: boolean, busy: string, polishing: boolean, progress: number, can_stop: boolean, saved: boolean, clip: string, document?: number, fresh?: boolean}} State
 * @typedef {{type: "stop"}} Stop
 * @typedef {{type: "swap", items: number[], source: string}} Swap
 * @typedef {{id: number, shape: string, name: string, weight: number, count: (number | null), stretch: number, is_word: boolean, held: [boolean, boolean, boolean], crop: ([number, number, number] | null), halo: string, parts: number}} Thing
 * @typedef {{kind: "together", commands: (Move | Turn | Scale | Exchange | Cover | Arrange | Align | Distribute | Hold | Release | Add | Duplicate | Remove | Replace | Weigh | Rename | Recolour | Flip | Group | Ungroup | SetContainer | Reshape | PlaceContainer | SetOption | Entitle | LeaveOut | Paint | SetMosaic | CropPhoto | Background | SetHalos | DrawContainer | SetLines)[]}} Together
 * @typedef {Ack | Alike | Begin | Bring | BeginChart | Copy | Count | Do | Fill | LeapMessage | Lines | Mix | More | Open | Order | OutlineMessage | Paste | Picture | Pour | Room | Set | Stop | Swap | Words} Told
 * @typedef {{kind: "turn", item: number, angle: number}} Turn
 * @typedef {{shape: string, matrix: [number, number, number, number, number, number], faint: boolean}} Underlay
 * @typedef {{kind: "ungroup", items: number[]}} Ungroup
 * @typedef {{type: "variant", seed: number, covered: number, command: Arrange}} Variant
 * @typedef {{kind: "weigh", items: number[], weight: number}} Weigh
 * @typedef {{type: "words", words: [string, number][], font?: (string | null)}} Words
 */
export {};
