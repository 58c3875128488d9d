// Names of columns in English, German, French, Spanish, Italian and Dutch, the most telling ones of a role first.

import type { Role } from "./mapping";

const words = (text: string): string[] => text.trim().split(/\s*,\s*/);

const level = words(`
  level, shelf level, shelf number, shelf, boden, fachboden, bodennummer, bodennr, regalboden, fachbodennummer, ebene,
  etage, fach, fachnummer, fachnr, niveau, tablette, numero tablette, nivel, balda, estante, livello, ripiano, piano,
  plank, plankniveau, legbord, schap
`);

const place = words(`
  position, pos, platz, platznummer, platznr, positionsnummer, stelle, place, x, xposition, x position, abstand, distance,
  offset, emplacement, posicion, distancia, posizione, distanza, positie, plaats, afstand
`);

export const headerWords: Record<Role, string[]> = {
  article: words(`
    ean, gtin, ean13, gtin13, ean code, eancode, upc, barcode, strichcode, code barres, codigo de barras, codice a barre,
    article, artikelnummer, artikelnr, artikel nr, artnr, artikel, article number, article no, item number, item, sku, plu,
    numero article, code article, ref article, reference, codigo articulo, articulo, referencia, codice articolo, articolo,
    codice, codigo, artikelcode, art code, product code, product id, produktnummer, materialnummer, material
  `),
  description: words(`
    description, artikelbezeichnung, bezeichnung, artikelname, artikeltext, kurztext, beschreibung, article name,
    product name, item name, produktname, product, produkt, name, article description, designation, libelle,
    libelle article, nom, produit, descripcion, denominacion, nombre, producto, descrizione, denominazione, nome, prodotto,
    omschrijving, artikelomschrijving, benaming, naam, text
  `),
  planogram: words(`
    planogram, planogramm, planogram name, planogram id, planogrammname, planogramme, planograma, planogramma, pog, pog name
  `),
  fixture: words(`
    fixture, regal, regalnummer, regalnr, regalname, mobel, moebel, mobelnummer, mobelname, gondel, gondola, rack,
    rack number, shelving, equipment, meuble, numero meuble, gondole, rayonnage, mueble, estanteria, scaffale, mobile,
    arredo, meubel, stelling, rek
  `),
  face: words("face, side, seite, regalseite, cote, cara, lado, lato, faccia, zijde, kant"),
  segment: words(
    "segment, segment number, bay, segmentnummer, modul, module, element, modulo, segmento, travee, campata",
  ),
  level,
  place: [
    ...words(
      "sequence, sequenz, reihenfolge, laufende nummer, lfdnr, lfd nr, ordre, secuencia, orden, sequenza, ordine",
    ),
    ...words("volgorde, volgnummer"),
    ...place,
  ],
  width: words("width, breite, artikelbreite, produktbreite, largeur, ancho, larghezza, breedte"),
  facings: words(`
    facings, hfacings, facings wide, facing, horizontal facings, frontstucke, facings breite, frentes, facciate
  `),
  type: words(`
    label type, type, labeltyp, etikettentyp, etikettyp, etikett, etikettenart, typ, esl type, esltyp, esl typ, esl,
    type etiquette, etiquette, tipo etiqueta, etiqueta, tipo etichetta, etichetta, tipo, labelsoort, etikettype
  `),
  hook: words("hook, hook length, haken, hakenlange, crochet, gancho, gancio, haak"),
  tilt: words("tilt, tilt deg, neigung, winkel, neigungswinkel, inclinaison, inclinacion, inclinazione, helling, hoek"),
};

/** Units behind a name: "Abstand (cm)", "x [mm]", "hook_cm". */
export const unitInHeader = (name: string): string | undefined =>
  /[\s([_](mm|cm|m|ft|in)\.?[)\]]?$/i.exec(name)?.[1].toLowerCase();
