import type { Rows } from './rows';

/** Texts of the step Export. */
export const EXPORT = {
  'export.format': ['Format', 'Format'],
  'export.variant': ['Entities', 'Elemente'],
  'export.faces': ['3DFACE', '3DFACE'],
  'export.polyface': ['Polyface', 'Polyface'],
  'export.mesh': ['MESH', 'MESH'],
  'export.limit': ['At most', 'Höchstens'],
  'export.triangles': ['triangles', 'Dreiecke'],
  'export.all': ['All', 'Alle'],
  'export.write': ['Export {format}', '{format} exportieren'],
  'export.about': ['about {size}, {triangles} triangles', 'etwa {size}, {triangles} Dreiecke'],
  'export.encoding': ['Encoding', 'Kodierung'],
  'export.binary': ['Binary', 'Binär'],
  'export.ascii': ['Text', 'Text'],
  'export.of': ['surface {version}, revision {revision}', 'Fläche {version}, Stand {revision}'],
  'export.files': ['Files', 'Dateien'],
  'export.none': ['Exported files appear here.', 'Hier erscheinen exportierte Dateien.'],
  'export.download': ['Download', 'Herunterladen'],
  'export.dxf': [
    'CAD programs; triangles on a layer, synthesized ones on another',
    'CAD-Programme; Dreiecke auf einer Ebene, ergänzte auf einer anderen',
  ],
  'export.stl': ['3D printing; triangles alone', '3D-Druck; nur Dreiecke'],
  'export.ply': ['Everything measured: sigma, views, marks', 'Alles Gemessene: Sigma, Ansichten, Herkunft'],
  'export.obj': ['Modelling programs', 'Modellierprogramme'],
  'export.glb': ['Web and presentation, with sigma', 'Web und Präsentation, mit Sigma'],
  'export.3mf': ['3D printing with units and colours', '3D-Druck mit Einheiten und Farben'],
  'export.zip': ['Scan folder as zip', 'Scan-Ordner als Zip'],
  'export.picture': ['Picture of the view', 'Bild der Ansicht'],
  'export.more': ['Also', 'Außerdem'],
} as const satisfies Rows;
