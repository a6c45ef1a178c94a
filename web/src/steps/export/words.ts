import { wordsOf } from '../../messages';

/** The texts of the step Export. */
export const words = wordsOf({
  'step.export': ['Export', 'Export', 'Esporta'],
  'export.format': ['Format', 'Format', 'Formato'],
  'export.variant': ['Entities', 'Elemente', 'Entità'],
  'export.faces': ['3DFACE', '3DFACE', '3DFACE'],
  'export.polyface': ['Polyface', 'Polyface', 'Polyface'],
  'export.mesh': ['MESH', 'MESH', 'MESH'],
  'export.limit': ['At most', 'Höchstens', 'Al massimo'],
  'export.triangles': ['triangles', 'Dreiecke', 'triangoli'],
  'export.all': ['All', 'Alle', 'Tutti'],
  'export.write': ['Export {format}', '{format} exportieren', 'Esporta {format}'],
  'export.about': [
    'about {size}, {triangles} triangles',
    'etwa {size}, {triangles} Dreiecke',
    'circa {size}, {triangles} triangoli',
  ],
  'export.encoding': ['Encoding', 'Kodierung', 'Codifica'],
  'export.binary': ['Binary', 'Binär', 'Binario'],
  'export.ascii': ['Text', 'Text', 'Testo'],
  'export.of': [
    'surface {version}, revision {revision}',
    'Fläche {version}, Stand {revision}',
    'superficie {version}, revisione {revision}',
  ],
  'export.files': ['Files', 'Dateien', 'File'],
  'export.none': [
    'Exported files appear here.',
    'Hier erscheinen exportierte Dateien.',
    'I file esportati appaiono qui.',
  ],
  'export.download': ['Download', 'Herunterladen', 'Scarica'],
  'export.dxf': [
    'CAD programs; triangles on a layer, synthesized ones on another',
    'CAD-Programme; Dreiecke auf einer Ebene, ergänzte auf einer anderen',
    'Programmi CAD; triangoli su un livello, aggiunti su un altro',
  ],
  'export.stl': ['3D printing; triangles alone', '3D-Druck; nur Dreiecke', 'Stampa 3D; solo triangoli'],
  'export.ply': [
    'Everything measured: sigma, views, marks',
    'Alles Gemessene: Sigma, Ansichten, Herkunft',
    'Tutto il misurato: sigma, viste, origine',
  ],
  'export.obj': ['Modelling programs', 'Modellierprogramme', 'Programmi di modellazione'],
  'export.glb': [
    'Web and presentation, with sigma',
    'Web und Präsentation, mit Sigma',
    'Web e presentazioni, con sigma',
  ],
  'export.3mf': [
    '3D printing with units and colours',
    '3D-Druck mit Einheiten und Farben',
    'Stampa 3D con unità e colori',
  ],
  'export.zip': ['Scan folder as zip', 'Scan-Ordner als Zip', 'Cartella della scansione come zip'],
  'export.picture': ['Picture of the view', 'Bild der Ansicht', 'Immagine della vista'],
  'export.more': ['Also', 'Außerdem', 'Inoltre'],
});
