<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>Annotation</name>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Line</source>
        <translation>Linie</translation>
    </message>
    <message>
        <source>Polygon</source>
        <translation>Polygon</translation>
    </message>
    <message>
        <source>Circle</source>
        <translation>Kreis</translation>
    </message>
    <message>
        <source>Square</source>
        <translation>Quadrat</translation>
    </message>
    <message>
        <source>Triangle</source>
        <translation>Dreieck</translation>
    </message>
    <message>
        <source>Diamond</source>
        <translation>Raute</translation>
    </message>
    <message>
        <source>Star</source>
        <translation>Stern</translation>
    </message>
    <message>
        <source>Cross</source>
        <translation>Kreuz</translation>
    </message>
</context>
<context>
    <name>Body</name>
    <message>
        <source>Mercury</source>
        <translation>Merkur</translation>
    </message>
    <message>
        <source>Venus</source>
        <translation>Venus</translation>
    </message>
    <message>
        <source>Earth</source>
        <translation>Erde</translation>
    </message>
    <message>
        <source>Moon</source>
        <translation>Mond</translation>
    </message>
    <message>
        <source>Mars</source>
        <translation>Mars</translation>
    </message>
    <message>
        <source>Phobos</source>
        <translation>Phobos</translation>
    </message>
    <message>
        <source>Deimos</source>
        <translation>Deimos</translation>
    </message>
    <message>
        <source>Eros</source>
        <translation>Eros</translation>
    </message>
    <message>
        <source>Vesta</source>
        <translation>Vesta</translation>
    </message>
    <message>
        <source>Ceres</source>
        <translation>Ceres</translation>
    </message>
    <message>
        <source>Io</source>
        <translation>Io</translation>
    </message>
    <message>
        <source>Europa</source>
        <translation>Europa</translation>
    </message>
    <message>
        <source>Ganymede</source>
        <translation>Ganymed</translation>
    </message>
    <message>
        <source>Callisto</source>
        <translation>Kallisto</translation>
    </message>
    <message>
        <source>Mimas</source>
        <translation>Mimas</translation>
    </message>
    <message>
        <source>Enceladus</source>
        <translation>Enceladus</translation>
    </message>
    <message>
        <source>Tethys</source>
        <translation>Tethys</translation>
    </message>
    <message>
        <source>Dione</source>
        <translation>Dione</translation>
    </message>
    <message>
        <source>Rhea</source>
        <translation>Rhea</translation>
    </message>
    <message>
        <source>Titan</source>
        <translation>Titan</translation>
    </message>
    <message>
        <source>Iapetus</source>
        <translation>Iapetus</translation>
    </message>
    <message>
        <source>Miranda</source>
        <translation>Miranda</translation>
    </message>
    <message>
        <source>Ariel</source>
        <translation>Ariel</translation>
    </message>
    <message>
        <source>Umbriel</source>
        <translation>Umbriel</translation>
    </message>
    <message>
        <source>Titania</source>
        <translation>Titania</translation>
    </message>
    <message>
        <source>Oberon</source>
        <translation>Oberon</translation>
    </message>
    <message>
        <source>Triton</source>
        <translation>Triton</translation>
    </message>
    <message>
        <source>Pluto</source>
        <translation>Pluto</translation>
    </message>
    <message>
        <source>Charon</source>
        <translation>Charon</translation>
    </message>
    <message>
        <source>the Earth</source>
        <extracomment>A body, in &quot;on the Earth&quot;</extracomment>
        <translation>Erde</translation>
    </message>
    <message>
        <source>the Moon</source>
        <extracomment>A body, in &quot;on the Moon&quot;</extracomment>
        <translation>Mond</translation>
    </message>
</context>
<context>
    <name>ColorRamp</name>
    <message>
        <source>Ember</source>
        <extracomment>A color ramp through purple and red to straw yellow</extracomment>
        <translation>Glut</translation>
    </message>
    <message>
        <source>Hypsometric</source>
        <extracomment>The color ramp of atlases: green lowlands, brown mountains</extracomment>
        <translation>Hypsometrisch</translation>
    </message>
    <message>
        <source>Lagoon</source>
        <extracomment>A color ramp from violet through teal to lime green</extracomment>
        <translation>Lagune</translation>
    </message>
    <message>
        <source>Dawn</source>
        <extracomment>A color ramp from blue to rose, as the sky at sunrise</extracomment>
        <translation>Morgenrot</translation>
    </message>
    <message>
        <source>Rust</source>
        <extracomment>A color ramp of the colors of Mars</extracomment>
        <translation>Rost</translation>
    </message>
    <message>
        <source>Gray</source>
        <extracomment>A color ramp from dark to light gray</extracomment>
        <translation>Grau</translation>
    </message>
    <message>
        <source>Diverging (at 0)</source>
        <extracomment>A color ramp with different colors below and above the elevation 0</extracomment>
        <translation>Divergierend (um 0)</translation>
    </message>
</context>
<context>
    <name>CoordinateMenu</name>
    <message>
        <source>0° to 360° East</source>
        <extracomment>A range of longitudes</extracomment>
        <translation>0° bis 360° Ost</translation>
    </message>
    <message>
        <source>180° West to 180° East</source>
        <extracomment>A range of longitudes</extracomment>
        <translation>180° West bis 180° Ost</translation>
    </message>
    <message>
        <source>0° to 360° West</source>
        <extracomment>A range of longitudes</extracomment>
        <translation>0° bis 360° West</translation>
    </message>
    <message>
        <source>Default for the Body</source>
        <extracomment>The range of longitudes that suits the map&apos;s body</extracomment>
        <translation>Wie auf dem Himmelskörper üblich</translation>
    </message>
    <message>
        <source>Default for %1 (%2)</source>
        <extracomment>The range of longitudes that suits a body: %1 is its name, %2 the range</extracomment>
        <translation>Wie auf %1 üblich (%2)</translation>
    </message>
    <message>
        <source>&amp;Decimal Degrees</source>
        <translation>&amp;Dezimalgrad</translation>
    </message>
    <message>
        <source>Degrees, &amp;Minutes, Seconds</source>
        <translation>Grad, &amp;Minuten, Sekunden</translation>
    </message>
    <message>
        <source>Ma&amp;p Coordinates: %1</source>
        <translation>Karten&amp;koordinaten: %1</translation>
    </message>
    <message>
        <source>Longitude</source>
        <extracomment>A part of a menu</extracomment>
        <translation>Länge</translation>
    </message>
    <message>
        <source>This Body</source>
        <translation>dieser Himmelskörper</translation>
    </message>
    <message>
        <source>Latitude on %1</source>
        <extracomment>A part of a menu; %1 is a body</extracomment>
        <translation>Breite auf %1</translation>
    </message>
</context>
<context>
    <name>CoreMessage</name>
    <message>
        <source>has samples beyond a pole or outside its projection; crop it</source>
        <translation>hat Werte jenseits eines Pols oder außerhalb seiner Projektion; schneiden Sie die Karte zu</translation>
    </message>
    <message>
        <source>has fewer than 2 columns or rows</source>
        <translation>hat weniger als 2 Spalten oder Zeilen</translation>
    </message>
    <message>
        <source>has fewer than 2 columns or rows off the poles</source>
        <translation>hat abseits der Pole weniger als 2 Spalten oder Zeilen</translation>
    </message>
    <message>
        <source>extends over %1° of longitude; a body has 360°</source>
        <translation>erstreckt sich über %1° Länge; ein Himmelskörper hat 360°</translation>
    </message>
    <message>
        <source>an equatorial radius of %1 m and a polar radius of %2 m are impossible; give a polar radius above 0 and not above the equatorial one</source>
        <translation>ein Äquatorradius von %1 m und ein Polradius von %2 m sind unmöglich; geben Sie einen Polradius über 0 an, der nicht über dem Äquatorradius liegt</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is not understood; write for example 18.65 N 226.2 E</source>
        <translation>„%1“ ist nicht verständlich; schreiben Sie zum Beispiel 18,65 N 226,2 O</translation>
    </message>
    <message>
        <source>a latitude and a longitude are needed; write for example 18.65 N 226.2 E</source>
        <translation>Breite und Länge sind nötig; schreiben Sie zum Beispiel 18,65 N 226,2 O</translation>
    </message>
    <message>
        <source>%1 and %2 are the same direction; write for example 18.65 N 226.2 E</source>
        <translation>%1 und %2 sind dieselbe Richtung; schreiben Sie zum Beispiel 18,65 N 226,2 O</translation>
    </message>
    <message>
        <source>%1 is too large; minutes and seconds must be below 60</source>
        <translation>%1 ist zu groß; Minuten und Sekunden liegen unter 60</translation>
    </message>
    <message>
        <source>latitude %1 is beyond 90 degrees</source>
        <translation>die Breite %1 liegt jenseits von 90 Grad</translation>
    </message>
    <message>
        <source>longitude %1 is beyond 360 degrees</source>
        <translation>die Länge %1 liegt jenseits von 360 Grad</translation>
    </message>
    <message>
        <source>enter two numbers, x and then y</source>
        <translation>geben Sie zwei Zahlen ein, erst x und dann y</translation>
    </message>
    <message>
        <source>does not exist</source>
        <translation>gibt es nicht</translation>
    </message>
    <message>
        <source>has %1 bytes, but SRTM tiles have %2 (1201 × 1201 samples) or %3 (3601 × 3601); it may be cut short; fetch it again</source>
        <translation>hat %1 Bytes, SRTM-Kacheln haben jedoch %2 (1201 × 1201 Werte) oder %3 (3601 × 3601); die Datei ist vielleicht abgeschnitten; laden Sie sie erneut herunter</translation>
    </message>
    <message>
        <source>is not a raster that GDAL can read, or is damaged; convert it to GeoTIFF or fetch it again</source>
        <translation>ist kein Raster, das GDAL lesen kann, oder ist beschädigt; wandeln Sie es in GeoTIFF um oder laden Sie es erneut herunter</translation>
    </message>
    <message>
        <source>is a color picture, not an elevation map</source>
        <translation>ist ein Farbbild und keine Höhenkarte</translation>
    </message>
    <message>
        <source>is one band of a color picture, read as elevations; open an elevation map instead</source>
        <translation>ist ein Kanal eines Farbbilds, der als Höhen gelesen wird; öffnen Sie stattdessen eine Höhenkarte</translation>
    </message>
    <message>
        <source>looks like a color picture: band %1 of %2 is read as elevations, and all are 8-bit values without a unit; open an elevation map instead</source>
        <translation>sieht wie ein Farbbild aus: Kanal %1 von %2 wird als Höhen gelesen, und alle sind 8-Bit-Werte ohne Einheit; öffnen Sie stattdessen eine Höhenkarte</translation>
    </message>
    <message>
        <source>names a data file that is missing; put it next to this file (%1)</source>
        <translation>nennt eine Datendatei, die fehlt; legen Sie sie neben diese Datei (%1)</translation>
    </message>
    <message>
        <source>is cut short or damaged: %1; fetch it again</source>
        <translation>ist abgeschnitten oder beschädigt: %1; laden Sie die Datei erneut herunter</translation>
    </message>
    <message>
        <source>block %1 of %2 ends at byte %3, the file at byte %4</source>
        <translation>Block %1 von %2 endet bei Byte %3, die Datei bei Byte %4</translation>
    </message>
    <message>
        <source>block %1 of %2 has %3 bytes, too few for its %4 of samples</source>
        <translation>Block %1 von %2 hat %3 Bytes, zu wenige für seine %4 Bytes an Abtastwerten</translation>
    </message>
    <message>
        <source>it declares %1 blocks of samples but lists %2</source>
        <translation>sie nennt %1 Blöcke von Abtastwerten, führt aber %2 auf</translation>
    </message>
    <message>
        <source>it declares a list of %1 blocks of samples that takes %2, but the whole file has %3</source>
        <translation>sie nennt eine Liste von %1 Blöcken von Abtastwerten, die %2 braucht, aber die ganze Datei hat %3</translation>
    </message>
    <message>
        <source>its directory is beyond the end of the file</source>
        <translation>ihr Verzeichnis liegt hinter dem Ende der Datei</translation>
    </message>
    <message>
        <source>its directories form a loop</source>
        <translation>ihre Verzeichnisse bilden eine Schleife</translation>
    </message>
    <message>
        <source>the archive is damaged: %1 in it cannot be unpacked; fetch it again</source>
        <translation>das Archiv ist beschädigt: %1 darin lässt sich nicht entpacken; laden Sie es erneut herunter</translation>
    </message>
    <message>
        <source>the file is cut short or damaged (%1); fetch it again</source>
        <translation>die Datei ist abgeschnitten oder beschädigt (%1); laden Sie sie erneut herunter</translation>
    </message>
    <message>
        <source>the file is cut short or damaged; fetch it again</source>
        <translation>die Datei ist abgeschnitten oder beschädigt; laden Sie sie erneut herunter</translation>
    </message>
    <message>
        <source>reading rows %1 to %2 failed: it is cut short, %3 of the %4 bytes that its header promises are present; fetch it again</source>
        <translation>die Zeilen %1 bis %2 lassen sich nicht lesen: Die Datei ist abgeschnitten, von den %4 Bytes, die ihr Kopf nennt, sind %3 vorhanden; laden Sie sie erneut herunter</translation>
    </message>
    <message>
        <source>%1 × %2 samples are not a surface; at least 2 × 2 are needed</source>
        <translation>%1 × %2 Abtastwerte sind keine Fläche; mindestens 2 × 2 sind nötig</translation>
    </message>
    <message>
        <source>contains no elevations; all of its %1 samples are nodata</source>
        <translation>enthält keine Höhen; alle %1 Abtastwerte sind Nodata</translation>
    </message>
    <message>
        <source>unknown CRS &quot;%1&quot;; enter an EPSG or IAU code, a PROJ string or WKT</source>
        <translation>unbekanntes KBS „%1“; geben Sie einen EPSG- oder IAU-Code, eine PROJ-Zeichenkette oder WKT ein</translation>
    </message>
    <message>
        <source>&quot;%1&quot; (unit %2) cannot place a grid in degrees (%3, %4); choose a CRS of longitude and latitude, or set a geotransform in its unit</source>
        <translation>„%1“ (Einheit %2) passt nicht zu einem Gitter in Grad (%3, %4); wählen Sie ein KBS mit Länge und Breite, oder legen Sie eine Geotransformation in dessen Einheit fest</translation>
    </message>
    <message>
        <source>&quot;%1&quot; (unit %2) cannot place a grid that covers x %3 to %4 and y %5 to %6; choose a projected CRS, or set a geotransform in degrees</source>
        <translation>„%1“ (Einheit %2) passt nicht zu einem Gitter von x %3 bis %4 und y %5 bis %6; wählen Sie ein projiziertes KBS, oder legen Sie eine Geotransformation in Grad fest</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is unknown; give its radii instead, or a name such as Mars, Moon, Earth, Vesta or Titan</source>
        <translation>„%1“ ist unbekannt; geben Sie stattdessen die Radien an oder einen Namen wie Mars, Moon, Earth, Vesta oder Titan</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is unknown; use m, km, ft or &quot;US survey ft&quot;</source>
        <translation>„%1“ ist unbekannt; verwenden Sie m, km, ft oder „US survey ft“</translation>
    </message>
    <message>
        <source>%1 cannot scale elevations; use a finite number other than 0</source>
        <translation>%1 kann Höhen nicht skalieren; verwenden Sie eine endliche Zahl außer 0</translation>
    </message>
    <message>
        <source>no CRS: map units are read as meters; set its CRS or body to get longitude and latitude</source>
        <translation>kein KBS: Karteneinheiten werden als Meter gelesen; legen Sie KBS oder Himmelskörper fest, um Länge und Breite zu erhalten</translation>
    </message>
    <message>
        <source>no CRS, but it looks like longitude and latitude in degrees (%1): set %2; until then, map units are read as meters</source>
        <translation>kein KBS, aber es sieht nach Länge und Breite in Grad aus (%1): Legen Sie %2 fest; bis dahin werden Karteneinheiten als Meter gelesen</translation>
    </message>
    <message>
        <source>the CRS &quot;%1&quot; (unit %2) does not fit the grid, which looks like longitude and latitude in degrees (%3): set %4</source>
        <translation>das KBS „%1“ (Einheit %2) passt nicht zum Gitter, das nach Länge und Breite in Grad aussieht (%3): Legen Sie %4 fest</translation>
    </message>
    <message>
        <source>the CRS &quot;%1&quot; of the file is not used: it is in degrees, but the grid covers x %2 to %3 and y %4 to %5; set the CRS; until then, map units are read as meters</source>
        <translation>das KBS „%1“ der Datei wird nicht verwendet: Es ist in Grad, aber das Gitter reicht von x %2 bis %3 und y %4 bis %5; legen Sie das KBS fest; bis dahin werden Karteneinheiten als Meter gelesen</translation>
    </message>
    <message>
        <source>no georeferencing in the file: each pixel is placed as one unit square; give a geotransform to place it</source>
        <translation>keine Georeferenzierung in der Datei: Jedes Pixel wird als Einheitsquadrat platziert; geben Sie eine Geotransformation an, um die Karte zu platzieren</translation>
    </message>
    <message>
        <source>no unit of elevation in the file, and the elevations look like feet: read as meters they reach %1 m, and the Earth&apos;s highest place is at %2 m; set the unit %3; until then, meters are assumed</source>
        <translation>keine Höheneinheit in der Datei, und die Höhen sehen nach Fuß aus: Als Meter gelesen reichen sie bis %1 m, und der höchste Ort der Erde liegt auf %2 m; legen Sie die Einheit %3 fest; bis dahin werden Meter angenommen</translation>
    </message>
    <message>
        <source>no unit of elevation in the file, and the elevations may be in %1, the unit of the CRS; set the unit %2; until then, meters are assumed</source>
        <translation>keine Höheneinheit in der Datei, und die Höhen sind vielleicht in %1, der Einheit des KBS; legen Sie die Einheit %2 fest; bis dahin werden Meter angenommen</translation>
    </message>
    <message>
        <source>the unit &quot;%1&quot; is not a known unit of length; meters are assumed</source>
        <translation>die Einheit „%1“ ist keine bekannte Längeneinheit; Meter werden angenommen</translation>
    </message>
    <message>
        <source>samples of %1 at an end of the range often mark nodata, but the file declares no nodata value; if they do, set it as nodata</source>
        <translation>Abtastwerte von %1 am Ende des Bereichs stehen oft für Nodata, aber die Datei nennt keinen Nodata-Wert; wenn sie das tun, legen Sie ihn als Nodata fest</translation>
    </message>
    <message>
        <source>the elevations reach %1 m, but the highest place %2 is at %3 m; a scale or a unit may be missing, or the map shows another body; set the scale, the unit or the body</source>
        <translation>die Höhen reichen bis %1 m, aber der höchste Ort %2 liegt auf %3 m; vielleicht fehlt eine Skalierung oder eine Einheit, oder die Karte zeigt einen anderen Himmelskörper; legen Sie die Skalierung, die Einheit oder den Himmelskörper fest</translation>
    </message>
    <message>
        <source>the elevations reach %1 m, but the lowest place %2 is at %3 m; a scale or a unit may be missing, or the map shows another body; set the scale, the unit or the body</source>
        <translation>die Höhen reichen bis %1 m, aber der tiefste Ort %2 liegt auf %3 m; vielleicht fehlt eine Skalierung oder eine Einheit, oder die Karte zeigt einen anderen Himmelskörper; legen Sie die Skalierung, die Einheit oder den Himmelskörper fest</translation>
    </message>
    <message>
        <source>on the Moon</source>
        <translation>auf dem Mond</translation>
    </message>
    <message>
        <source>on the Earth</source>
        <translation>auf der Erde</translation>
    </message>
    <message>
        <source>on Mars</source>
        <translation>auf dem Mars</translation>
    </message>
    <message>
        <source>on Mercury</source>
        <translation>auf dem Merkur</translation>
    </message>
    <message>
        <source>the sample %1 makes an elevation of %2 m, which is implausible; set it as nodata, or set the unit or the scale</source>
        <translation>der Abtastwert %1 ergibt eine Höhe von %2 m, was unplausibel ist; legen Sie ihn als Nodata fest, oder legen Sie die Einheit oder die Skalierung fest</translation>
    </message>
    <message>
        <source>a preview of %1 × %2 samples is shown; elevations are read from it until all %3 × %4 are available</source>
        <translation>eine Vorschau aus %1 × %2 Abtastwerten wird gezeigt; Höhen werden aus ihr gelesen, bis alle %3 × %4 verfügbar sind</translation>
    </message>
    <message>
        <source>from the label %1: %2 (GDAL reads %3)</source>
        <translation>aus dem Label %1: %2 (GDAL liest %3)</translation>
    </message>
    <message>
        <source>shifted by %1 column and %2 row to match the latitude and longitude limits in the label</source>
        <translation>um %1 Spalte und %2 Zeile verschoben, damit die Grenzen von Breite und Länge im Label stimmen</translation>
    </message>
    <message>
        <source>its detail is estimated because it has no level file</source>
        <translation>der Detailgrad ist geschätzt, weil es keine Stufendatei gibt</translation>
    </message>
    <message>
        <source>its extent is %1, %2</source>
        <translation>die Ausdehnung ist %1, %2</translation>
    </message>
    <message>
        <source>from the file&apos;s metadata: %1 (GDAL reads %2)</source>
        <translation>aus den Metadaten der Datei: %1 (GDAL liest %2)</translation>
    </message>
    <message>
        <source>the file&apos;s metadata give scale %1 and offset %2, which are not applied to floating-point samples; set scale and offset if they should be (--scale, --offset)</source>
        <translation>die Metadaten der Datei nennen Skalierung %1 und Versatz %2, die auf Gleitkommawerte nicht angewandt werden; setzen Sie Skalierung und Versatz, wenn sie gelten sollen (--scale, --offset)</translation>
    </message>
    <message>
        <source>opened %1 in place of %2</source>
        <translation>%1 anstelle von %2 geöffnet</translation>
    </message>
    <message>
        <source>the points coincide, so they have no plane; choose points apart from each other</source>
        <translation>die Punkte fallen zusammen und haben darum keine Ebene; wählen Sie Punkte mit Abstand</translation>
    </message>
    <message>
        <source>the points are nearly on a line (%1 m long, %2 m wide), so their plane is not determined; add points away from that line</source>
        <translation>die Punkte liegen fast auf einer Linie (%1 m lang, %2 m breit), sodass ihre Ebene nicht bestimmt ist; fügen Sie Punkte abseits dieser Linie hinzu</translation>
    </message>
    <message>
        <source>the points are nearly on a line in plan (%1 m long, %2 m wide), so that any elevations give a vertical plane; add points away from that line</source>
        <translation>die Punkte liegen im Grundriss fast auf einer Linie (%1 m lang, %2 m breit), sodass beliebige Höhen eine senkrechte Ebene ergeben; fügen Sie Punkte abseits dieser Linie hinzu</translation>
    </message>
    <message>
        <source>the plane is uncertain by %1 degrees, more than %2; choose points that are farther apart along azimuth %3°, or closer to one plane</source>
        <translation>die Ebene ist auf %1 Grad unsicher, mehr als %2; wählen Sie Punkte, die im Azimut %3° weiter auseinander oder näher an einer Ebene liegen</translation>
    </message>
    <message>
        <source>position %1 (%2, %3) is outside the map or on nodata; choose another position</source>
        <translation>Position %1 (%2, %3) liegt außerhalb der Karte oder auf Nodata; wählen Sie eine andere Position</translation>
    </message>
    <message>
        <source>the rim points are nearly on a line, so their circle is not determined; add points on other sides of the rim</source>
        <translation>die Punkte des Randes liegen fast auf einer Linie, sodass ihr Kreis nicht bestimmt ist; fügen Sie Punkte auf anderen Seiten des Randes hinzu</translation>
    </message>
    <message>
        <source>an edge of the polygon leaves the map&apos;s projection; choose positions on the map</source>
        <translation>eine Kante des Polygons verlässt die Projektion der Karte; wählen Sie Positionen auf der Karte</translation>
    </message>
    <message>
        <source>was measured while the map had no CRS; measure it again</source>
        <translation>wurde gemessen, als die Karte kein KBS hatte; messen Sie erneut</translation>
    </message>
    <message>
        <source>was measured on a body, but the map has no CRS now; set its CRS again</source>
        <translation>wurde auf einem Körper gemessen, aber die Karte hat jetzt kein KBS; legen Sie ihr KBS wieder fest</translation>
    </message>
</context>
<context>
    <name>Drawing</name>
    <message>
        <source>Remove %1</source>
        <extracomment>A step of undo; %1 is a name</extracomment>
        <translation>%1 entfernen</translation>
    </message>
    <message>
        <source>Remove %1 Items</source>
        <translation>%1 Objekte entfernen</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>Edit Note</source>
        <translation>Notiz bearbeiten</translation>
    </message>
    <message>
        <source>Color of %1</source>
        <translation>Farbe von %1</translation>
    </message>
    <message>
        <source>Color of %1 Items</source>
        <translation>Farbe von %1 Objekten</translation>
    </message>
    <message>
        <source>Remove Point</source>
        <translation>Punkt entfernen</translation>
    </message>
    <message>
        <source>Move Point</source>
        <translation>Punkt verschieben</translation>
    </message>
    <message>
        <source>Add Point to %1</source>
        <extracomment>A step of undo; %1 is a name</extracomment>
        <translation>Punkt zu %1 hinzufügen</translation>
    </message>
    <message>
        <source>Insert Point</source>
        <translation>Punkt einfügen</translation>
    </message>
</context>
<context>
    <name>Gestures</name>
    <message>
        <source>Left drag</source>
        <translation>Ziehen mit links</translation>
    </message>
    <message>
        <source>Right or middle drag</source>
        <translation>Ziehen mit rechts oder Mitte</translation>
    </message>
    <message>
        <source>Right drag</source>
        <translation>Ziehen mit rechts</translation>
    </message>
    <message>
        <source>Middle drag</source>
        <translation>Ziehen mit Mitte</translation>
    </message>
    <message>
        <source>Drag</source>
        <extracomment>With any button</extracomment>
        <translation>Ziehen</translation>
    </message>
    <message>
        <source>Click</source>
        <translation>Klick</translation>
    </message>
    <message>
        <source>Right click</source>
        <translation>Rechtsklick</translation>
    </message>
    <message>
        <source>Double click</source>
        <translation>Doppelklick</translation>
    </message>
    <message>
        <source>Wheel</source>
        <translation>Rad</translation>
    </message>
    <message>
        <source>Wheel while pressing</source>
        <translation>Rad beim Drücken</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <extracomment>%1 is a gesture of the mouse, %2 the tool that has to be chosen for it</extracomment>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Pan: the terrain follows the pointer</source>
        <translation>Verschieben: Das Gelände folgt dem Zeiger</translation>
    </message>
    <message>
        <source>Turn and tilt</source>
        <translation>Drehen und neigen</translation>
    </message>
    <message>
        <source>Press into the terrain</source>
        <translation>In das Gelände drücken</translation>
    </message>
    <message>
        <source>Zoom to the pointer</source>
        <translation>Zum Zeiger hin vergrößern</translation>
    </message>
    <message>
        <source>Zoom finely</source>
        <translation>Fein vergrößern</translation>
    </message>
    <message>
        <source>Press deeper or less deep</source>
        <translation>Stärker oder schwächer drücken</translation>
    </message>
    <message>
        <source>Fly there</source>
        <translation>Dorthin fliegen</translation>
    </message>
    <message>
        <source>Context menu</source>
        <extracomment>Of the place on the map that is clicked</extracomment>
        <translation>Kontextmenü</translation>
    </message>
    <message>
        <source>Add a point</source>
        <translation>Einen Punkt hinzufügen</translation>
    </message>
    <message>
        <source>Move a point</source>
        <translation>Einen Punkt verschieben</translation>
    </message>
    <message>
        <source>Finish the measurement or annotation</source>
        <translation>Die Messung oder Anmerkung beenden</translation>
    </message>
    <message>
        <source>Select a feature and show its attributes</source>
        <translation>Ein Objekt auswählen und seine Attribute zeigen</translation>
    </message>
</context>
<context>
    <name>HeightText</name>
    <message>
        <source>%1 … %2 %3</source>
        <extracomment>A range of heights; %3 is their unit</extracomment>
        <translation>%1 … %2 %3</translation>
    </message>
</context>
<context>
    <name>Measure</name>
    <message>
        <source>Geodesic distance</source>
        <translation>Geodätische Entfernung</translation>
    </message>
    <message>
        <source>Along the terrain</source>
        <translation>Entlang des Geländes</translation>
    </message>
    <message>
        <source>Straight line</source>
        <translation>Gerade Linie</translation>
    </message>
    <message>
        <source>Rise</source>
        <translation>Höhenunterschied</translation>
    </message>
    <message>
        <source>Azimuth</source>
        <translation>Azimut</translation>
    </message>
    <message>
        <source>Lowest</source>
        <translation>Tiefster Punkt</translation>
    </message>
    <message>
        <source>Highest</source>
        <translation>Höchster Punkt</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>Total ascent</source>
        <translation>Gesamtanstieg</translation>
    </message>
    <message>
        <source>Total descent</source>
        <translation>Gesamtabstieg</translation>
    </message>
    <message>
        <source>Mean slope</source>
        <translation>Mittlere Neigung</translation>
    </message>
    <message>
        <source>Steepest slope</source>
        <translation>Größte Neigung</translation>
    </message>
    <message>
        <source>Geodesic area</source>
        <translation>Geodätische Fläche</translation>
    </message>
    <message>
        <source>Perimeter</source>
        <translation>Umfang</translation>
    </message>
    <message>
        <source>Terrain area</source>
        <translation>Geländeoberfläche</translation>
    </message>
    <message>
        <source>Volume above the border&apos;s plane</source>
        <translation>Volumen über der Randebene</translation>
    </message>
    <message>
        <source>Volume below it</source>
        <translation>Volumen darunter</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Hinweis</translation>
    </message>
    <message>
        <source>Strike (right-hand rule)</source>
        <translation>Streichen (Rechte-Hand-Regel)</translation>
    </message>
    <message>
        <source>Dip</source>
        <translation>Fallen</translation>
    </message>
    <message>
        <source>undetermined</source>
        <extracomment>The direction of a plane that may be level</extracomment>
        <translation>unbestimmt</translation>
    </message>
    <message>
        <source>Dip direction</source>
        <translation>Fallrichtung</translation>
    </message>
    <message>
        <source>Dip error (95 %)</source>
        <translation>Fehler des Fallens (95 %)</translation>
    </message>
    <message>
        <source>Strike error (95 %)</source>
        <translation>Fehler des Streichens (95 %)</translation>
    </message>
    <message>
        <source>RMS distance from the plane</source>
        <translation>Mittlerer quadratischer Abstand von der Ebene</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Diameter</source>
        <translation>Durchmesser</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>Depth to diameter</source>
        <translation>Tiefe zu Durchmesser</translation>
    </message>
    <message>
        <source>Rim</source>
        <translation>Rand</translation>
    </message>
    <message>
        <source>Floor</source>
        <translation>Boden</translation>
    </message>
    <message>
        <source>RMS distance from the circle</source>
        <translation>Mittlerer quadratischer Abstand vom Kreis</translation>
    </message>
    <message>
        <source>Rim points</source>
        <translation>Randpunkte</translation>
    </message>
    <message>
        <source>Elevation</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Slope</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>Aspect</source>
        <translation>Exposition</translation>
    </message>
    <message>
        <source>no data</source>
        <extracomment>In place of a number: the terrain has no data there</extracomment>
        <translation>keine Daten</translation>
    </message>
    <message>
        <source>Leg %1</source>
        <translation>Abschnitt %1</translation>
    </message>
    <message>
        <source>%1 toward %2</source>
        <translation>%1 nach %2</translation>
    </message>
    <message>
        <source>The border crosses itself</source>
        <translation>Der Rand kreuzt sich selbst</translation>
    </message>
    <message>
        <source>⌀ %1</source>
        <extracomment>A diameter</extracomment>
        <translation>⌀ %1</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Entfernung</translation>
    </message>
    <message>
        <source>Profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>Area and Volume</source>
        <translation>Fläche und Volumen</translation>
    </message>
    <message>
        <source>Strike and Dip</source>
        <translation>Streichen und Fallen</translation>
    </message>
    <message>
        <source>Crater</source>
        <translation>Krater</translation>
    </message>
    <message>
        <source>Elevation and Slope</source>
        <translation>Höhe und Neigung</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Point %1</source>
        <extracomment>%1 is a number</extracomment>
        <translation>Punkt %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>Center</source>
        <translation>Mitte</translation>
    </message>
    <message>
        <source>Errors</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>three points: no error estimate</source>
        <extracomment>In place of errors</extracomment>
        <translation>drei Punkte: keine Fehlerschätzung</translation>
    </message>
    <message>
        <source>%1, depth %2, d/D %3</source>
        <extracomment>A crater: %1 is its diameter, %2 its depth, %3 depth to diameter</extracomment>
        <translation>%1, Tiefe %2, d/D %3</translation>
    </message>
</context>
<context>
    <name>NumberText</name>
    <message>
        <source>%1 %2</source>
        <extracomment>A number and its unit</extracomment>
        <translation>%1 %2</translation>
    </message>
</context>
<context>
    <name>OverlayText</name>
    <message>
        <source>%1 km</source>
        <extracomment>A length in kilometers</extracomment>
        <translation>%1 km</translation>
    </message>
    <message>
        <source>%1 m</source>
        <extracomment>A length in meters</extracomment>
        <translation>%1 m</translation>
    </message>
    <message>
        <source>%1° (%2)</source>
        <extracomment>A heading: %1 is degrees clockwise from north, %2 the same in words</extracomment>
        <translation>%1° (%2)</translation>
    </message>
    <message>
        <source>north</source>
        <translation>Nord</translation>
    </message>
    <message>
        <source>north-north-east</source>
        <translation>Nordnordost</translation>
    </message>
    <message>
        <source>north-east</source>
        <translation>Nordost</translation>
    </message>
    <message>
        <source>east-north-east</source>
        <translation>Ostnordost</translation>
    </message>
    <message>
        <source>east</source>
        <translation>Ost</translation>
    </message>
    <message>
        <source>east-south-east</source>
        <translation>Ostsüdost</translation>
    </message>
    <message>
        <source>south-east</source>
        <translation>Südost</translation>
    </message>
    <message>
        <source>south-south-east</source>
        <translation>Südsüdost</translation>
    </message>
    <message>
        <source>south</source>
        <translation>Süd</translation>
    </message>
    <message>
        <source>south-south-west</source>
        <translation>Südsüdwest</translation>
    </message>
    <message>
        <source>south-west</source>
        <translation>Südwest</translation>
    </message>
    <message>
        <source>west-south-west</source>
        <translation>Westsüdwest</translation>
    </message>
    <message>
        <source>west</source>
        <translation>West</translation>
    </message>
    <message>
        <source>west-north-west</source>
        <translation>Westnordwest</translation>
    </message>
    <message>
        <source>north-west</source>
        <translation>Nordwest</translation>
    </message>
    <message>
        <source>north-north-west</source>
        <translation>Nordnordwest</translation>
    </message>
</context>
<context>
    <name>PictureWriter</name>
    <message>
        <source>%1: unknown picture format; choose a name that ends in .png, .jpg or .tif</source>
        <extracomment>%1 is a file</extracomment>
        <translation>%1: unbekanntes Bildformat; wählen Sie einen Namen, der auf .png, .jpg oder .tif endet</translation>
    </message>
    <message>
        <source>%1: cannot write the picture (%2); choose another folder</source>
        <extracomment>%1 is a file, %2 the reason</extracomment>
        <translation>%1: Das Bild kann nicht geschrieben werden (%2); wählen Sie einen anderen Ordner</translation>
    </message>
</context>
<context>
    <name>PlaceFacts</name>
    <message>
        <source>N</source>
        <extracomment>The eight points of the compass</extracomment>
        <translation>N</translation>
    </message>
    <message>
        <source>NE</source>
        <translation>NO</translation>
    </message>
    <message>
        <source>E</source>
        <translation>O</translation>
    </message>
    <message>
        <source>SE</source>
        <translation>SO</translation>
    </message>
    <message>
        <source>S</source>
        <translation>S</translation>
    </message>
    <message>
        <source>SW</source>
        <translation>SW</translation>
    </message>
    <message>
        <source>W</source>
        <translation>W</translation>
    </message>
    <message>
        <source>NW</source>
        <translation>NW</translation>
    </message>
    <message>
        <source>%1° (%2)</source>
        <extracomment>A direction: %1 is degrees clockwise from north, %2 a point of the compass</extracomment>
        <translation>%1° (%2)</translation>
    </message>
    <message>
        <source>≈ %1</source>
        <extracomment>A value that is not yet exact</extracomment>
        <translation>≈ %1</translation>
    </message>
    <message>
        <source>Layer</source>
        <translation>Layer</translation>
    </message>
    <message>
        <source>Coordinates</source>
        <translation>Koordinaten</translation>
    </message>
    <message>
        <source>Elevation</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>none (nodata)</source>
        <translation>keine (Nodata)</translation>
    </message>
    <message>
        <source>Slope</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>%1°</source>
        <extracomment>A slope in degrees</extracomment>
        <translation>%1°</translation>
    </message>
    <message>
        <source>Aspect</source>
        <translation>Exposition</translation>
    </message>
    <message>
        <source>none (level)</source>
        <translation>keine (eben)</translation>
    </message>
    <message>
        <source>Sample</source>
        <translation>Abtastwert</translation>
    </message>
    <message>
        <source>column %1, row %2</source>
        <extracomment>The nearest sample of the raster, counted from 0</extracomment>
        <translation>Spalte %1, Zeile %2</translation>
    </message>
</context>
<context>
    <name>PlaceName</name>
    <message>
        <source>m</source>
        <translation>m</translation>
    </message>
    <message>
        <source>km</source>
        <translation>km</translation>
    </message>
    <message>
        <source>crater</source>
        <translation>Krater</translation>
    </message>
    <message>
        <source>canyon</source>
        <translation>Canyon</translation>
    </message>
    <message>
        <source>cape</source>
        <translation>Kap</translation>
    </message>
    <message>
        <source>chaotic terrain</source>
        <translation>chaotisches Gelände</translation>
    </message>
    <message>
        <source>crater chain</source>
        <translation>Kraterkette</translation>
    </message>
    <message>
        <source>dunes</source>
        <translation>Dünen</translation>
    </message>
    <message>
        <source>hollow</source>
        <translation>Mulde</translation>
    </message>
    <message>
        <source>landing site</source>
        <translation>Landestelle</translation>
    </message>
    <message>
        <source>mountain</source>
        <translation>Berg</translation>
    </message>
    <message>
        <source>plain</source>
        <translation>Ebene</translation>
    </message>
    <message>
        <source>plateau</source>
        <translation>Hochebene</translation>
    </message>
    <message>
        <source>region</source>
        <translation>Region</translation>
    </message>
    <message>
        <source>ridge</source>
        <translation>Rücken</translation>
    </message>
    <message>
        <source>scarp</source>
        <translation>Steilstufe</translation>
    </message>
    <message>
        <source>sea</source>
        <extracomment>A dark plain of lava: Mare, Oceanus, Sinus, Lacus, Palus</extracomment>
        <translation>Mare</translation>
    </message>
    <message>
        <source>trough</source>
        <translation>Graben</translation>
    </message>
    <message>
        <source>valley</source>
        <translation>Tal</translation>
    </message>
    <message>
        <source>patera</source>
        <extracomment>Patera: a crater with scalloped edges, mostly of a volcano</extracomment>
        <translation>Patera</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <extracomment>What a place is, and its diameter</extracomment>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>%1 is outside the map.</source>
        <extracomment>%1 is the name of a place</extracomment>
        <translation>%1 liegt außerhalb der Karte.</translation>
    </message>
    <message>
        <source>Open a file of names with File › Open Names…</source>
        <translation>Öffnen Sie mit Datei › Namen öffnen … eine Datei mit Namen.</translation>
    </message>
    <message>
        <source>No names on an unknown body.</source>
        <translation>Keine Namen für einen unbekannten Himmelskörper.</translation>
    </message>
    <message>
        <source>No names on %1.</source>
        <translation>Keine Namen für %1.</translation>
    </message>
    <message>
        <source>No place on %2 is named “%1”.</source>
        <extracomment>%1 is a text that was typed, %2 a body</extracomment>
        <translation>Kein Ort heißt „%1“ (%2).</translation>
    </message>
    <message>
        <source>No place is named “%1”.</source>
        <translation>Kein Ort heißt „%1“.</translation>
    </message>
    <message>
        <source>Did you mean “%1”?</source>
        <translation>Meinten Sie „%1“?</translation>
    </message>
</context>
<context>
    <name>RecentFiles</name>
    <message>
        <source>%1 — %2/</source>
        <extracomment>In a list of files: %1 is a file&apos;s name, %2 the end of its folder&apos;s path</extracomment>
        <translation>%1 — %2/</translation>
    </message>
</context>
<context>
    <name>Report</name>
    <message>
        <source>in the middle of the picture</source>
        <translation>in der Bildmitte</translation>
    </message>
    <message>
        <source>N</source>
        <extracomment>On a north arrow: north</extracomment>
        <translation>N</translation>
    </message>
    <message>
        <source>Vertical exaggeration %1</source>
        <extracomment>Below a diagram; %1 is a number: elevations are drawn so many times larger than distances</extracomment>
        <translation>Überhöhung %1</translation>
    </message>
    <message>
        <source>Contours every %1</source>
        <extracomment>%1 is the elevation from one contour line to the next</extracomment>
        <translation>Höhenlinien alle %1</translation>
    </message>
    <message>
        <source>Slope (°)</source>
        <translation>Neigung (°)</translation>
    </message>
    <message>
        <source>Elevation (%1)</source>
        <extracomment>%1 is a unit</extracomment>
        <translation>Höhe (%1)</translation>
    </message>
    <message>
        <source>The view in the window, with %1 in its middle. %2. Vertical exaggeration ×%3</source>
        <extracomment>Below a map; %1 is the position in its middle, %2 a body and a CRS, %3 a factor</extracomment>
        <translation>Die Ansicht im Fenster, mit %1 in der Mitte. %2. Überhöhung ×%3</translation>
    </message>
    <message>
        <source>Layers</source>
        <translation>Layer</translation>
    </message>
    <message>
        <source>Layer</source>
        <translation>Layer</translation>
    </message>
    <message>
        <source>Body and CRS</source>
        <translation>Himmelskörper und KBS</translation>
    </message>
    <message>
        <source>Samples</source>
        <translation>Abtastwerte</translation>
    </message>
    <message>
        <source>Pixel</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>Elevations</source>
        <translation>Höhen</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <extracomment>Heading: %1 is a measurement, %2 its kind</extracomment>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Equal-area net of the lower hemisphere: planes, poles, and their 95 % confidence; dotted: the mean plane, with its pole in a ring</source>
        <translation>Flächentreues Netz der unteren Halbkugel: Ebenen, Pole und ihre 95-%-Vertrauensbereiche; gepunktet: die mittlere Ebene, ihr Pol im Ring</translation>
    </message>
    <message>
        <source>Equal-area net of the lower hemisphere: planes, poles, and their 95 % confidence</source>
        <translation>Flächentreues Netz der unteren Halbkugel: Ebenen, Pole und ihre 95-%-Vertrauensbereiche</translation>
    </message>
    <message>
        <source>Attitudes</source>
        <translation>Lagerungen</translation>
    </message>
    <message>
        <source>Made with MarsView %1, %2</source>
        <extracomment>At the foot of a report; %1 is a version, %2 a date</extracomment>
        <translation>Erstellt mit MarsView %1, %2</translation>
    </message>
    <message>
        <source>Page %1 of %2</source>
        <extracomment>Page number: %1 of %2</extracomment>
        <translation>Seite %1 von %2</translation>
    </message>
    <message>
        <source>%1: cannot write the report (%2); choose another folder</source>
        <extracomment>%1 is a file, %2 the reason</extracomment>
        <translation>%1: Der Bericht kann nicht geschrieben werden (%2); wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
        <source>Area by classes of elevation (bars), and the share of the area that lies above an elevation (line)</source>
        <translation>Fläche nach Höhenklassen (Balken) und der Anteil der Fläche, der über einer Höhe liegt (Linie)</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Elevation</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>from %1</source>
        <extracomment>Of a line or border: %1 is the position of its first point</extracomment>
        <translation>ab %1</translation>
    </message>
    <message>
        <source>Annotations</source>
        <translation>Anmerkungen</translation>
    </message>
    <message>
        <source>The first %1 of %2 annotations</source>
        <extracomment>%1 and %2 are numbers</extracomment>
        <translation>Die ersten %1 von %2 Anmerkungen</translation>
    </message>
</context>
<context>
    <name>SaveChart</name>
    <message>
        <source>CSV table (*.csv)</source>
        <translation>CSV-Tabelle (*.csv)</translation>
    </message>
    <message>
        <source>PNG picture (*.png)</source>
        <translation>PNG-Bild (*.png)</translation>
    </message>
    <message>
        <source>SVG drawing (*.svg)</source>
        <translation>SVG-Zeichnung (*.svg)</translation>
    </message>
    <message>
        <source>PDF document (*.pdf)</source>
        <translation>PDF-Dokument (*.pdf)</translation>
    </message>
    <message>
        <source>%1 cannot be written; choose another folder</source>
        <translation>%1 kann nicht geschrieben werden; wählen Sie einen anderen Ordner</translation>
    </message>
</context>
<context>
    <name>SizeText</name>
    <message>
        <source>%1 kB</source>
        <extracomment>Size of files: kilobytes</extracomment>
        <translation>%1 kB</translation>
    </message>
    <message>
        <source>%1 MB</source>
        <extracomment>Size of files: megabytes</extracomment>
        <translation>%1 MB</translation>
    </message>
    <message>
        <source>%1 GB</source>
        <extracomment>Size of files: gigabytes</extracomment>
        <translation>%1 GB</translation>
    </message>
</context>
<context>
    <name>TimeText</name>
    <message>
        <source>less than a minute left</source>
        <extracomment>How long something still takes</extracomment>
        <translation>noch weniger als eine Minute</translation>
    </message>
    <message numerus="yes">
        <source>%n min left</source>
        <extracomment>How long something still takes</extracomment>
        <translation>
            <numerusform>noch %n min</numerusform>
            <numerusform>noch %n min</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>Tool</name>
    <message>
        <source>&amp;Pan</source>
        <extracomment>A tool: drag moves the map</extracomment>
        <translation>&amp;Verschieben</translation>
    </message>
    <message>
        <source>&amp;Touch</source>
        <extracomment>A tool: drag presses the stylus into the terrain</extracomment>
        <translation>&amp;Ertasten</translation>
    </message>
    <message>
        <source>&amp;Orbit</source>
        <extracomment>A tool: drag turns and tilts the view</extracomment>
        <translation>&amp;Drehen</translation>
    </message>
    <message>
        <source>&amp;Measure</source>
        <extracomment>A tool: clicks place the points of a measurement</extracomment>
        <translation>&amp;Messen</translation>
    </message>
    <message>
        <source>Drag to move the terrain (%1)</source>
        <extracomment>%1 is a key</extracomment>
        <translation>Ziehen verschiebt das Gelände (%1)</translation>
    </message>
    <message>
        <source>Drag to feel the terrain; the wheel presses deeper (%1)</source>
        <extracomment>%1 is a key</extracomment>
        <translation>Ziehen, um das Gelände zu fühlen; das Rad drückt stärker (%1)</translation>
    </message>
    <message>
        <source>Drag to turn and tilt the view (%1)</source>
        <extracomment>%1 is a key</extracomment>
        <translation>Ziehen dreht und neigt die Ansicht (%1)</translation>
    </message>
    <message>
        <source>Click to place the points of a measurement (%1)</source>
        <extracomment>%1 is a key</extracomment>
        <translation>Klicks setzen die Punkte einer Messung (%1)</translation>
    </message>
    <message>
        <source>A drag with the left button moves the terrain with the pointer. With every tool, a drag with the right button turns and tilts the view, Shift and a drag pan, and the wheel zooms to the pointer.</source>
        <translation>Ziehen mit der linken Taste bewegt das Gelände mit dem Zeiger. Mit jedem Werkzeug dreht und neigt Ziehen mit der rechten Taste die Ansicht, Umschalt und Ziehen verschiebt sie, und das Rad vergrößert zum Zeiger hin.</translation>
    </message>
    <message>
        <source>A drag with the left button presses the stylus, a red cone, into the terrain; the wheel presses deeper. The meter shows the force. A connected haptic device touches whatever the tool is.</source>
        <translation>Ziehen mit der linken Taste drückt den Stift, einen roten Kegel, in das Gelände; das Rad drückt stärker. Die Anzeige nennt die Kraft. Ein verbundenes haptisches Gerät ertastet das Gelände mit jedem Werkzeug.</translation>
    </message>
    <message>
        <source>A drag with the left button turns and tilts the view about the terrain in the middle of the picture.</source>
        <translation>Ziehen mit der linken Taste dreht und neigt die Ansicht um das Gelände in der Bildmitte.</translation>
    </message>
    <message>
        <source>&amp;Annotate</source>
        <extracomment>A tool: clicks place the points of an annotation</extracomment>
        <translation>&amp;Anmerken</translation>
    </message>
    <message>
        <source>Click to draw points, lines and polygons (%1)</source>
        <extracomment>%1 is a key</extracomment>
        <translation>Klicken, um Punkte, Linien und Polygone zu zeichnen (%1)</translation>
    </message>
    <message>
        <source>A click, or Enter, places a point of the measurement; a double click, or Enter again in the same place, finishes it. Drag a point to move it, drag a line to insert one; Backspace removes the last one, or the one under the pointer. Choose what to measure in the Measure menu.</source>
        <translation>Ein Klick oder die Eingabetaste setzt einen Punkt der Messung; ein Doppelklick oder die Eingabetaste noch einmal an derselben Stelle beendet sie. Einen Punkt ziehen verschiebt ihn, eine Linie ziehen fügt einen ein; die Rücktaste entfernt den letzten oder den unter dem Zeiger. Was gemessen wird, steht im Menü Messen.</translation>
    </message>
    <message>
        <source>A click, or Enter, places a point of the annotation; a double click, or Enter again in the same place, finishes a line or polygon. Drag a point to move it, drag a line to insert one; Backspace removes the last one, or the one under the pointer. Choose what to draw in the Annotate menu.</source>
        <translation>Ein Klick oder die Eingabetaste setzt einen Punkt der Anmerkung; ein Doppelklick oder die Eingabetaste noch einmal an derselben Stelle beendet eine Linie oder ein Polygon. Einen Punkt ziehen verschiebt ihn, eine Linie ziehen fügt einen ein; die Rücktaste entfernt den letzten oder den unter dem Zeiger. Was gezeichnet wird, steht im Menü Anmerken.</translation>
    </message>
</context>
<context>
    <name>ViewName</name>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <extracomment>A name that is taken, with a number after it</extracomment>
        <translation>%1 (%2)</translation>
    </message>
</context>
<context>
    <name>WhatsThis</name>
    <message>
        <source>The terrain. A drag with the left button uses the selected tool: pan, touch or orbit. A drag with the right button turns and tilts, the wheel zooms to the pointer, a double click flies there, and a right click opens a menu for the place.</source>
        <translation>Das Gelände. Ziehen mit der linken Taste tut, was das Werkzeug sagt: verschieben, ertasten oder drehen. Ziehen mit der rechten Taste dreht und neigt, das Rad vergrößert zum Zeiger hin, ein Doppelklick fliegt dorthin, und ein Rechtsklick öffnet ein Menü für den Ort.</translation>
    </message>
    <message>
        <source>The needle points north. Click to turn north to the top.</source>
        <translation>Die Nadel zeigt nach Norden. Ein Klick dreht Norden nach oben.</translation>
    </message>
    <message>
        <source>The length of the bar on the terrain in the middle of the picture.</source>
        <translation>Die Länge des Balkens auf dem Gelände in der Bildmitte.</translation>
    </message>
    <message>
        <source>Position and elevation under the pointer or under the stylus of a haptic device, read from the full-resolution surface, and how far the drawn surface is off, in pixels.</source>
        <translation>Position und Höhe unter dem Zeiger oder unter dem Stift eines haptischen Geräts, aus der Oberfläche in voller Auflösung, und um wie viele Pixel die gezeichnete Oberfläche abweicht.</translation>
    </message>
    <message>
        <source>Maps that are loading or being built, with their progress and a button to stop.</source>
        <translation>Karten, die geladen oder vorbereitet werden, mit ihrem Fortschritt und einer Schaltfläche zum Anhalten.</translation>
    </message>
    <message>
        <source>The open maps as layers, topmost first, grouped by body. Tick a layer to show it, drag it to move it, choose its color ramp below.</source>
        <translation>Die geöffneten Karten als Layer, die oberste zuerst, nach Himmelskörpern gruppiert. Ein Häkchen zeigt einen Layer, Ziehen ordnet ihn um; seine Farbskala wählen Sie darunter.</translation>
    </message>
    <message>
        <source>Where the active layer lies: body, ellipsoid, CRS, pixel size, extent and elevation unit. Set Body, CRS… sets what the file lacks or states wrongly.</source>
        <translation>Wo der aktive Layer liegt: Himmelskörper, Ellipsoid, KBS, Pixelgröße, Ausdehnung und Höheneinheit. „Raumbezug festlegen …“ setzt, was der Datei fehlt oder was sie falsch angibt.</translation>
    </message>
    <message>
        <source>Haptic devices: connect one, set how the terrain feels, record and replay touches, and stop all forces.</source>
        <translation>Haptische Geräte: verbinden Sie eines, stellen Sie ein, wie sich das Gelände anfühlt, zeichnen Sie Berührungen auf und spielen Sie sie ab, und schalten Sie alle Kräfte ab.</translation>
    </message>
    <message>
        <source>Opens any elevation raster that GDAL reads as a new layer.</source>
        <translation>Öffnet ein beliebiges Höhenraster, das GDAL liest, als neuen Layer.</translation>
    </message>
    <message>
        <source>Saves what the map shows, with legend, compass and scale bar.</source>
        <translation>Speichert, was die Karte zeigt, mit Legende, Kompass und Maßstabsbalken.</translation>
    </message>
    <message>
        <source>Shows the whole map from the south.</source>
        <translation>Zeigt die ganze Karte von Süden.</translation>
    </message>
    <message>
        <source>Turns the view until north is at the top.</source>
        <translation>Dreht die Ansicht, bis Norden oben ist.</translation>
    </message>
    <message>
        <source>Chooses the azimuth and altitude of the light that shades the terrain.</source>
        <translation>Wählt Azimut und Höhe des Lichts, das das Gelände schattiert.</translation>
    </message>
    <message>
        <source>Shows all layers of one body where they lie on it, or the flat map again.</source>
        <translation>Zeigt alle Layer eines Himmelskörpers dort, wo sie auf ihm liegen, oder wieder die ebene Karte.</translation>
    </message>
    <message>
        <source>The whole topmost map, or all of a body that is seen as a globe. The outline is what the view shows. Click or drag to look at another place.</source>
        <translation>Die ganze oberste Karte oder, auf dem Globus, der ganze Himmelskörper. Der Umriss ist, was die Ansicht zeigt. Klicken oder ziehen Sie, um einen anderen Ort zu sehen.</translation>
    </message>
    <message>
        <source>What the colors of the terrain represent. Arrows at the ends mean that values beyond them have the color of the end.</source>
        <translation>Was die Farben des Geländes bedeuten. Pfeile an den Enden bedeuten, dass Werte jenseits davon die Farbe des Endes haben.</translation>
    </message>
    <message>
        <source>How to move over the map with mouse and keys. Each way that was tried gets a check mark. Esc closes the hint, and Help › Keys and Mouse lists everything.</source>
        <translation>Wie Sie sich mit Maus und Tasten über die Karte bewegen. Was Sie ausprobiert haben, bekommt ein Häkchen. Esc schließt den Hinweis, und Hilfe › Tastatur und Maus nennt alles.</translation>
    </message>
    <message>
        <source>A notice about the active layer, the picture, a file or a device. Its button solves the problem or offers a choice, Details shows where it comes from, and × closes it.</source>
        <translation>Ein Hinweis zum aktiven Layer, zum Bild, zu einer Datei oder zu einem Gerät. Seine Schaltfläche löst das Problem oder bietet eine Auswahl, „Einzelheiten“ zeigt, woher er kommt, und × schließt ihn.</translation>
    </message>
</context>
<context>
    <name>WindowCommands</name>
    <message>
        <source>Project</source>
        <translation>Projekt</translation>
    </message>
    <message>
        <source>Cannot Export Contours</source>
        <translation>Die Höhenlinien können nicht exportiert werden</translation>
    </message>
    <message>
        <source>Cannot Open Vector File</source>
        <translation>Die Vektordatei kann nicht geöffnet werden</translation>
    </message>
    <message>
        <source>Cannot Open Names</source>
        <translation>Die Namen können nicht geöffnet werden</translation>
    </message>
    <message>
        <source>%1 moves the camera</source>
        <extracomment>In the status bar, for a few seconds; %1 is a device</extracomment>
        <translation>%1 bewegt die Kamera</translation>
    </message>
    <message>
        <source>%1 was unplugged</source>
        <extracomment>In the status bar, for a few seconds; %1 is a device</extracomment>
        <translation>%1 wurde ausgesteckt</translation>
    </message>
    <message>
        <source>Annotations</source>
        <translation>Anmerkungen</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <extracomment>In the status bar, for a few seconds; %1 is a list of files</extracomment>
        <translation>Gespeichert: %1</translation>
    </message>
</context>
<context>
    <name>marsview</name>
    <message>
        <source>the Qt platform &quot;%1&quot; cannot show OpenGL windows; start with a display, for example under xvfb-run</source>
        <translation>Die Qt-Plattform „%1“ kann keine OpenGL-Fenster zeigen; starten Sie mit einer Anzeige, zum Beispiel unter xvfb-run</translation>
    </message>
    <message>
        <source>no OpenGL context can be created; install the graphics driver, or Mesa&apos;s software one (libgl1-mesa-dri)</source>
        <translation>Es kann kein OpenGL-Kontext erzeugt werden; installieren Sie den Grafiktreiber oder den Softwaretreiber von Mesa (libgl1-mesa-dri)</translation>
    </message>
    <message>
        <source>OpenGL 3.3 is required, but the graphics driver offers %1.%2; install a newer driver or Mesa&apos;s software one</source>
        <translation>OpenGL 3.3 ist nötig, aber der Grafiktreiber bietet %1.%2; installieren Sie einen neueren Treiber oder den Softwaretreiber von Mesa</translation>
    </message>
    <message>
        <source>S</source>
        <extracomment>South, behind a latitude</extracomment>
        <translation>S</translation>
    </message>
    <message>
        <source>E</source>
        <extracomment>East, behind a longitude</extracomment>
        <translation>O</translation>
    </message>
    <message>
        <source>W</source>
        <extracomment>West, behind a longitude</extracomment>
        <translation>W</translation>
    </message>
    <message>
        <source>N</source>
        <extracomment>North, behind a latitude</extracomment>
        <translation>N</translation>
    </message>
    <message>
        <source>%1° %2</source>
        <extracomment>A latitude or longitude: %1 is degrees, %2 N, S, E or W</extracomment>
        <translation>%1° %2</translation>
    </message>
    <message>
        <source>%1° %2′ %3</source>
        <extracomment>Degrees and minutes, then N, S, E or W</extracomment>
        <translation>%1° %2′ %3</translation>
    </message>
    <message>
        <source>%1° %2′ %3″ %4</source>
        <extracomment>Degrees, minutes and seconds, then N, S, E or W</extracomment>
        <translation>%1° %2′ %3″ %4</translation>
    </message>
    <message>
        <source>geocentric</source>
        <translation>geozentrisch</translation>
    </message>
    <message>
        <source>planetocentric</source>
        <translation>planetozentrisch</translation>
    </message>
    <message>
        <source>geodetic</source>
        <translation>geodätisch</translation>
    </message>
    <message>
        <source>planetographic</source>
        <translation>planetographisch</translation>
    </message>
    <message>
        <source>map, no CRS</source>
        <translation>Karte, kein KBS</translation>
    </message>
    <message>
        <source>map</source>
        <translation>Karte</translation>
    </message>
    <message>
        <source>%1°, %2°</source>
        <extracomment>Map coordinates that are degrees: %1 is x, %2 is y</extracomment>
        <translation>%1°, %2°</translation>
    </message>
    <message>
        <source>%1, %2 %3</source>
        <extracomment>Map coordinates: %1 is x, %2 is y, %3 their unit</extracomment>
        <translation>%1, %2 %3</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <extracomment>%1 is the latitude, %2 the longitude</extracomment>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>%1 – %2</source>
        <extracomment>A span of longitude or latitude, from %1 to %2</extracomment>
        <translation>%1 – %2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>unknown body</source>
        <translation>unbekannter Himmelskörper</translation>
    </message>
    <message>
        <source>Simulated hand</source>
        <extracomment>A device that is computed instead of built, to try touching without one</extracomment>
        <translation>Simulierte Hand</translation>
    </message>
    <message>
        <source>Force off: emergency stop</source>
        <translation>Kraft aus: Notaus</translation>
    </message>
    <message>
        <source>Force off: device lost; plug it in again</source>
        <translation>Kraft aus: Gerät verloren; stecken Sie es wieder ein</translation>
    </message>
    <message>
        <source>Force off: the recording has ended</source>
        <translation>Kraft aus: Die Aufzeichnung ist zu Ende</translation>
    </message>
    <message>
        <source>Force off: device not ready; calibrate it, or release its own emergency stop</source>
        <translation>Kraft aus: Gerät nicht bereit; kalibrieren Sie es oder lösen Sie seinen eigenen Notaus</translation>
    </message>
    <message>
        <source>Force off: the device responds too late</source>
        <translation>Kraft aus: Das Gerät antwortet zu spät</translation>
    </message>
    <message>
        <source>Force off: implausible device reading</source>
        <translation>Kraft aus: unglaubwürdiger Messwert des Geräts</translation>
    </message>
    <message>
        <source>Force off: the stylus is not held</source>
        <translation>Kraft aus: Der Stift wird nicht gehalten</translation>
    </message>
    <message>
        <source>Force off: deadlines missed; this computer is too busy</source>
        <translation>Kraft aus: Fristen versäumt; dieser Rechner ist überlastet</translation>
    </message>
    <message>
        <source>The device no longer answers; switch it off and connect it again</source>
        <translation>Das Gerät antwortet nicht mehr; schalten Sie es aus und verbinden Sie es erneut</translation>
    </message>
    <message>
        <source>Force off: terrain data not loaded</source>
        <translation>Kraft aus: Geländedaten nicht geladen</translation>
    </message>
    <message>
        <source>Force off: internal error (invalid force)</source>
        <translation>Kraft aus: interner Fehler (ungültige Kraft)</translation>
    </message>
    <message>
        <source>Force off: no layer to touch</source>
        <translation>Kraft aus: kein Layer zum Tasten</translation>
    </message>
    <message>
        <source>Touching the terrain</source>
        <extracomment>What the hand with a haptic device does</extracomment>
        <translation>Berührt das Gelände</translation>
    </message>
    <message>
        <source>Free motion</source>
        <translation>Freie Bewegung</translation>
    </message>
    <message>
        <source>Moving the map</source>
        <translation>Verschiebt die Karte</translation>
    </message>
    <message>
        <source>Zooming the map</source>
        <translation>Vergrößert oder verkleinert die Karte</translation>
    </message>
    <message>
        <source>Real-time scheduling and locked memory granted.</source>
        <translation>Echtzeitplanung und gesperrter Speicher gewährt.</translation>
    </message>
    <message>
        <source>Real-time scheduling granted, locked memory not granted (%1). Touch works without it.</source>
        <extracomment>%1 is the system&apos;s reason</extracomment>
        <translation>Echtzeitplanung gewährt, gesperrter Speicher nicht (%1). Das Tasten funktioniert auch so.</translation>
    </message>
    <message>
        <source>Real-time scheduling not granted (%1). Touch works, less steadily while the computer is busy.</source>
        <extracomment>%1 is the system&apos;s reason</extracomment>
        <translation>Echtzeitplanung nicht gewährt (%1). Das Tasten funktioniert, aber weniger gleichmäßig, wenn der Rechner ausgelastet ist.</translation>
    </message>
    <message>
        <source>%1: %2 updates recorded</source>
        <extracomment>%1 is a file, %2 a number</extracomment>
        <translation>%1: %2 Aktualisierungen aufgezeichnet</translation>
    </message>
    <message>
        <source>%1: %2 updates recorded; stopped: layer changed or closed</source>
        <translation>%1: %2 Aktualisierungen aufgezeichnet; angehalten: Layer gewechselt oder geschlossen</translation>
    </message>
    <message>
        <source>%1: %2 ticks of %3 s</source>
        <extracomment>%1 is a file, %2 a number, %3 a number of seconds</extracomment>
        <translation>%1: %2 Takte von %3 s</translation>
    </message>
    <message>
        <source>All goals of %1 are outside the map; open the map that it was recorded on</source>
        <extracomment>%1 is a file</extracomment>
        <translation>Alle Zielpunkte von %1 liegen außerhalb der Karte; öffnen Sie die Karte, auf der aufgezeichnet wurde</translation>
    </message>
    <message>
        <source>%1: %2 of %3 goals are outside the map and are clamped to its edge.</source>
        <extracomment>%1 is a file, %2 and %3 are numbers</extracomment>
        <translation>%1: %2 von %3 Zielpunkten liegen außerhalb der Karte und werden auf ihren Rand gesetzt.</translation>
    </message>
    <message>
        <source>The last line of %1 is incomplete and is skipped.</source>
        <extracomment>%1 is a file</extracomment>
        <translation>Die letzte Zeile von %1 ist unvollständig und wird übersprungen.</translation>
    </message>
    <message>
        <source>%1 was recorded on a map that is not open: %2 × %3 samples, %4.</source>
        <extracomment>%1 is a file, %2 and %3 are numbers of samples, %4 is a planet or a moon</extracomment>
        <translation>%1 wurde auf einer Karte aufgezeichnet, die nicht geöffnet ist: %2 × %3 Abtastwerte, %4.</translation>
    </message>
    <message>
        <source>Layers touched as one surface in %1: %2 when it was recorded, %3 now.</source>
        <extracomment>%1 is a file, %2 and %3 are numbers of layers</extracomment>
        <translation>Ebenen, die in %1 als eine Oberfläche ertastet werden: %2 bei der Aufnahme, jetzt %3.</translation>
    </message>
    <message>
        <source>%1 was recorded with %2 at exaggeration %3; it is replayed with %4 at %5.</source>
        <extracomment>%1 is a file, %2 and %4 are contact models, %3 and %5 numbers</extracomment>
        <translation>%1 wurde mit %2 bei Überhöhung %3 aufgezeichnet; abgespielt wird mit %4 bei %5.</translation>
    </message>
    <message>
        <source>%1 was replayed to its end</source>
        <extracomment>%1 is a file</extracomment>
        <translation>%1 wurde bis zum Ende abgespielt</translation>
    </message>
    <message>
        <source>%1 µs</source>
        <translation>%1 µs</translation>
    </message>
    <message>
        <source>%1 N</source>
        <extracomment>A force in newtons</extracomment>
        <translation>%1 N</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>sphere of radius %1</source>
        <extracomment>A vertical datum: %1 is a radius in meters</extracomment>
        <translation>Kugel mit Radius %1</translation>
    </message>
    <message>
        <source>areoid</source>
        <extracomment>The vertical datum of Mars: a surface of equal potential</extracomment>
        <translation>Areoid</translation>
    </message>
    <message>
        <source>EGM96 geoid</source>
        <extracomment>The vertical datum of many maps of the Earth</extracomment>
        <translation>EGM96-Geoid</translation>
    </message>
</context>
<context>
    <name>marsview::AboutDialog</name>
    <message>
        <source>About MarsView</source>
        <translation>Über MarsView</translation>
    </message>
    <message>
        <source>MarsView</source>
        <translation>MarsView</translation>
    </message>
    <message>
        <source>Explore very large topographic maps by sight and by touch.</source>
        <translation>Sehr große topographische Karten sehen und ertasten.</translation>
    </message>
    <message>
        <source>Version</source>
        <translation>Version</translation>
    </message>
    <message>
        <source>GDAL</source>
        <translation>GDAL</translation>
    </message>
    <message>
        <source>Qt</source>
        <translation>Qt</translation>
    </message>
    <message>
        <source>OpenGL</source>
        <translation>OpenGL</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>License</source>
        <translation>Lizenz</translation>
    </message>
    <message>
        <source>MIT License; with QCustomPlot, which draws its diagrams, this program is distributed under the GNU General Public License, version 3</source>
        <translation>MIT-Lizenz; mit QCustomPlot, das seine Diagramme zeichnet, wird dieses Programm unter der GNU General Public License, Version 3, weitergegeben</translation>
    </message>
    <message>
        <source>Icon of the program</source>
        <translation>Symbol des Programms</translation>
    </message>
</context>
<context>
    <name>marsview::AddressDialog</name>
    <message>
        <source>An address begins with https://, http://, s3://, gs:// or file://. Names of GDAL, such as /vsizip/maps.zip/dem.tif, can be opened, too.</source>
        <translation>Eine Adresse beginnt mit https://, http://, s3://, gs:// oder file://. Auch Namen von GDAL wie /vsizip/karten.zip/dem.tif lassen sich öffnen.</translation>
    </message>
    <message>
        <source>Not an address: the name of the server is missing, or it contains a character that addresses cannot have.</source>
        <translation>Keine Adresse: Der Name des Servers fehlt, oder sie enthält ein Zeichen, das in Adressen nicht vorkommt.</translation>
    </message>
    <message>
        <source>The address names a server or a folder; name a file there.</source>
        <translation>Die Adresse nennt einen Server oder einen Ordner; nennen Sie eine Datei darin.</translation>
    </message>
    <message>
        <source>Open Address</source>
        <translation>Adresse öffnen</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>A cloud-optimized GeoTIFF is read in pieces: only the tiles shown or touched are downloaded, and kept on disk for later.</source>
        <translation>Ein cloud-optimiertes GeoTIFF wird stückweise gelesen: Nur die Kacheln, die gezeigt oder ertastet werden, werden geladen und für später auf der Platte behalten.</translation>
    </message>
    <message>
        <source>Whether this address can be opened</source>
        <translation>Ob diese Adresse geöffnet werden kann</translation>
    </message>
    <message>
        <source>&amp;Address</source>
        <translation>&amp;Adresse</translation>
    </message>
    <message>
        <source>&amp;Open</source>
        <translation>&amp;Öffnen</translation>
    </message>
</context>
<context>
    <name>marsview::AnnotationCommands</name>
    <message>
        <source>Import Annotations</source>
        <translation>Anmerkungen importieren</translation>
    </message>
    <message>
        <source>Vector files (*.gpkg *.geojson *.json *.kml *.shp *.csv)</source>
        <translation>Vektordateien (*.gpkg *.geojson *.json *.kml *.shp *.csv)</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Import %1</source>
        <extracomment>A step of undo; %1 is a file</extracomment>
        <translation>%1 importieren</translation>
    </message>
    <message>
        <source>1 annotation imported from %1</source>
        <extracomment>In the status bar; %1 is a file</extracomment>
        <translation>1 Anmerkung aus %1 importiert</translation>
    </message>
    <message>
        <source>%L1 annotations imported from %2</source>
        <extracomment>In the status bar; %1 is a number above 1, %2 a file</extracomment>
        <translation>%L1 Anmerkungen aus %2 importiert</translation>
    </message>
    <message>
        <source>%1 states longitude and latitude on the Earth, but the map is of %2. Read them as longitude and latitude on %2?</source>
        <extracomment>%1 is a file, %2 a body</extracomment>
        <translation>%1 nennt Länge und Breite auf der Erde, aber die Karte liegt auf einem anderen Himmelskörper: %2. Sollen sie als Länge und Breite dort gelesen werden?</translation>
    </message>
    <message>
        <source>Export Annotations</source>
        <translation>Anmerkungen exportieren</translation>
    </message>
    <message>
        <source>GeoPackage (*.gpkg)</source>
        <translation>GeoPackage (*.gpkg)</translation>
    </message>
    <message>
        <source>GeoJSON (*.geojson)</source>
        <translation>GeoJSON (*.geojson)</translation>
    </message>
    <message>
        <source>KML (*.kml)</source>
        <translation>KML (*.kml)</translation>
    </message>
    <message>
        <source>Shapefile (*.shp)</source>
        <translation>Shapefile (*.shp)</translation>
    </message>
    <message>
        <source>CSV table (*.csv)</source>
        <translation>CSV-Tabelle (*.csv)</translation>
    </message>
    <message>
        <source>annotations</source>
        <translation>Anmerkungen</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <extracomment>In the status bar: %1 is a file</extracomment>
        <translation>%1 wird gelesen</translation>
    </message>
    <message>
        <source>Writing %1</source>
        <extracomment>In the status bar: %1 is a file</extracomment>
        <translation>%1 wird geschrieben</translation>
    </message>
</context>
<context>
    <name>marsview::AnnotationController</name>
    <message>
        <source>Point %1</source>
        <translation>Punkt %1</translation>
    </message>
    <message>
        <source>Line %1</source>
        <translation>Linie %1</translation>
    </message>
    <message>
        <source>Polygon %1</source>
        <translation>Polygon %1</translation>
    </message>
    <message>
        <source>Change Symbol</source>
        <translation>Symbol ändern</translation>
    </message>
</context>
<context>
    <name>marsview::AnnotationList</name>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Body</source>
        <translation>Himmelskörper</translation>
    </message>
    <message>
        <source>Annotations</source>
        <translation>Anmerkungen</translation>
    </message>
    <message>
        <source>&amp;Symbol</source>
        <translation>&amp;Symbol</translation>
    </message>
</context>
<context>
    <name>marsview::AnnotationMarks</name>
    <message>
        <source>Annotations on the map</source>
        <translation>Anmerkungen auf der Karte</translation>
    </message>
</context>
<context>
    <name>marsview::AnnotationPanel</name>
    <message>
        <source>Choose Point, Line or Polygon in the Annotate menu and click on the map.</source>
        <translation>Wählen Sie im Menü Anmerken Punkt, Linie oder Polygon und klicken Sie auf die Karte.</translation>
    </message>
</context>
<context>
    <name>marsview::AttitudesView</name>
    <message>
        <source>Diagram of attitudes</source>
        <translation>Diagramm der Lagerungen</translation>
    </message>
    <message>
        <source>Stereonet</source>
        <translation>Lagenkugel</translation>
    </message>
    <message>
        <source>Rose Diagram</source>
        <translation>Richtungsrose</translation>
    </message>
    <message>
        <source>Save &amp;Attitudes…</source>
        <translation>&amp;Lagerungen speichern …</translation>
    </message>
    <message>
        <source>Save all attitudes as CSV, or the diagram as PNG, SVG or PDF</source>
        <translation>Alle Lagerungen als CSV oder das Diagramm als PNG, SVG oder PDF speichern</translation>
    </message>
    <message>
        <source>Further attitudes are added to this diagram, with their mean.</source>
        <translation>Weitere Lagerungen werden diesem Diagramm hinzugefügt, mit ihrem Mittel.</translation>
    </message>
    <message>
        <source>Attitudes: %1</source>
        <translation>Lagerungen: %1</translation>
    </message>
    <message>
        <source>Mean plane: strike %1, dip %2</source>
        <extracomment>Of planes: %1 is the strike, %2 the dip</extracomment>
        <translation>Mittlere Ebene: Streichen %1, Fallen %2</translation>
    </message>
    <message>
        <source>Mean pole: trend %1, plunge %2</source>
        <extracomment>Of planes: %1 is the trend, %2 the plunge</extracomment>
        <translation>Mittlerer Pol: Azimut %1, Abtauchen %2</translation>
    </message>
    <message>
        <source>Fisher&apos;s κ: %1</source>
        <extracomment>Fisher&apos;s concentration of poles</extracomment>
        <translation>Fisher-κ: %1</translation>
    </message>
    <message>
        <source>95 % cone: %1</source>
        <extracomment>%1 is the half angle of a cone</extracomment>
        <translation>95-%-Kegel: %1</translation>
    </message>
    <message>
        <source>Save Attitudes</source>
        <translation>Lagerungen speichern</translation>
    </message>
    <message>
        <source>Cannot Save Attitudes</source>
        <translation>Die Lagerungen können nicht gespeichert werden</translation>
    </message>
    <message>
        <source>attitudes</source>
        <translation>Lagerungen</translation>
    </message>
</context>
<context>
    <name>marsview::Compass</name>
    <message>
        <source>Turn north up</source>
        <translation>Nach Norden ausrichten</translation>
    </message>
    <message>
        <source>Compass; press to turn north up</source>
        <translation>Kompass; drücken, um nach Norden auszurichten</translation>
    </message>
    <message>
        <source>Looking toward %1</source>
        <extracomment>%1 is a heading, for example &quot;332° (north-north-west)&quot;</extracomment>
        <translation>Blick nach %1</translation>
    </message>
    <message>
        <source>N</source>
        <extracomment>The letter for north on the compass</extracomment>
        <translation>N</translation>
    </message>
</context>
<context>
    <name>marsview::ContourLabelsView</name>
    <message>
        <source>Elevations of contour lines</source>
        <translation>Höhen der Höhenlinien</translation>
    </message>
</context>
<context>
    <name>marsview::ContourTools</name>
    <message>
        <source>Contour Interval</source>
        <translation>Äquidistanz</translation>
    </message>
    <message>
        <source>Export Contours</source>
        <translation>Höhenlinien exportieren</translation>
    </message>
    <message>
        <source>GeoPackage (*.gpkg)</source>
        <translation>GeoPackage (*.gpkg)</translation>
    </message>
    <message>
        <source>Shapefile (*.shp)</source>
        <translation>Shapefile (*.shp)</translation>
    </message>
    <message>
        <source>%1-contours.gpkg</source>
        <extracomment>The name of a file of contours: %1 is the map</extracomment>
        <translation>%1-hoehenlinien.gpkg</translation>
    </message>
    <message>
        <source>Exporting contours to %1</source>
        <translation>Höhenlinien werden nach %1 exportiert</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
</context>
<context>
    <name>marsview::CoordinateField</name>
    <message>
        <source>Click to copy the coordinates</source>
        <translation>Klicken, um die Koordinaten zu kopieren</translation>
    </message>
    <message>
        <source>Copied</source>
        <extracomment>In place of a position, for a moment after it was copied to the clipboard</extracomment>
        <translation>Kopiert</translation>
    </message>
</context>
<context>
    <name>marsview::CoordinatesPage</name>
    <message>
        <source>Decimal degrees</source>
        <translation>Dezimalgrad</translation>
    </message>
    <message>
        <source>Degrees, minutes, seconds</source>
        <translation>Grad, Minuten, Sekunden</translation>
    </message>
    <message>
        <source>Map coordinates (CRS)</source>
        <translation>Kartenkoordinaten (KBS)</translation>
    </message>
    <message>
        <source>Coordinate format</source>
        <translation>Koordinatenformat</translation>
    </message>
    <message>
        <source>Range of longitudes</source>
        <translation>Bereich der Längen</translation>
    </message>
    <message>
        <source>Default for the body</source>
        <extracomment>The range of longitudes that suits each body</extracomment>
        <translation>Üblich für den Himmelskörper</translation>
    </message>
    <message>
        <source>Body whose kind of latitude is chosen</source>
        <translation>Himmelskörper, dessen Breitenart gewählt wird</translation>
    </message>
    <message>
        <source>Kind of latitude on the body</source>
        <translation>Art der Breite auf dem Himmelskörper</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>Format</translation>
    </message>
    <message>
        <source>&amp;Coordinates</source>
        <translation>&amp;Koordinaten</translation>
    </message>
    <message>
        <source>&amp;Longitude</source>
        <translation>&amp;Länge</translation>
    </message>
    <message>
        <source>L&amp;atitude on</source>
        <extracomment>In front of a body and a kind of latitude</extracomment>
        <translation>&amp;Breite auf</translation>
    </message>
    <message>
        <source>Examples</source>
        <extracomment>A group: one place in each format of coordinates</extracomment>
        <translation>Beispiele</translation>
    </message>
    <message>
        <source>All kinds of latitude are the same on a sphere</source>
        <translation>Auf einer Kugel sind alle Breitenarten gleich</translation>
    </message>
</context>
<context>
    <name>marsview::Crosshair</name>
    <message>
        <source>Crosshair</source>
        <translation>Fadenkreuz</translation>
    </message>
</context>
<context>
    <name>marsview::CrsField</name>
    <message>
        <source>Matching coordinate reference systems</source>
        <translation>Passende Koordinatenbezugssysteme</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <extracomment>A coordinate reference system in a list: %1 is its name, %2 its code</extracomment>
        <translation>%1 (%2)</translation>
    </message>
</context>
<context>
    <name>marsview::DeviceSession</name>
    <message>
        <source>The program ended unexpectedly while %1 was connected. Press Connect to use it again</source>
        <translation>Das Programm endete unerwartet, während %1 verbunden war. Drücken Sie Verbinden, um es wieder zu benutzen</translation>
    </message>
    <message>
        <source>%1 was lost; plug it in again</source>
        <translation>%1 ging verloren; stecken Sie es wieder ein</translation>
    </message>
    <message>
        <source>%1 was lost: %2</source>
        <extracomment>%1 is a device, %2 a sentence about it</extracomment>
        <translation>%1 ging verloren: %2</translation>
    </message>
</context>
<context>
    <name>marsview::DrawnList</name>
    <message>
        <source>Select all</source>
        <translation>Alles auswählen</translation>
    </message>
    <message>
        <source>&amp;Go There</source>
        <translation>&amp;Gehe dorthin</translation>
    </message>
    <message>
        <source>Re&amp;name</source>
        <translation>&amp;Umbenennen</translation>
    </message>
    <message>
        <source>Edit No&amp;te</source>
        <translation>&amp;Notiz bearbeiten</translation>
    </message>
    <message>
        <source>&amp;Color…</source>
        <translation>&amp;Farbe …</translation>
    </message>
    <message>
        <source>&amp;Usual Color</source>
        <translation>&amp;Übliche Farbe</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
</context>
<context>
    <name>marsview::ElidedLabel</name>
    <message>
        <source>&amp;Copy</source>
        <translation>&amp;Kopieren</translation>
    </message>
</context>
<context>
    <name>marsview::ExaggerationBox</name>
    <message>
        <source>×</source>
        <extracomment>Before a factor of vertical exaggeration</extracomment>
        <translation>×</translation>
    </message>
    <message>
        <source>Vertical exaggeration factor</source>
        <translation>Überhöhungsfaktor</translation>
    </message>
    <message>
        <source>Vertical exaggeration: type a factor, or press + and − in the map</source>
        <translation>Überhöhung: Geben Sie einen Faktor ein oder drücken Sie + und − in der Karte</translation>
    </message>
    <message>
        <source>Vertical exaggeration goes from ×%1 to ×%2.</source>
        <extracomment>%1 and %2 are factors of vertical exaggeration</extracomment>
        <translation>Die Überhöhung reicht von ×%1 bis ×%2.</translation>
    </message>
</context>
<context>
    <name>marsview::ExaggerationControl</name>
    <message>
        <source>How many times elevations are exaggerated in the picture. Numbers, measurements and files are never exaggerated. 1:1 shows the true shape.</source>
        <translation>Wie vielfach Höhen im Bild überhöht sind. Zahlen, Messungen und Dateien sind nie überhöht. 1:1 zeigt die wahre Form.</translation>
    </message>
    <message>
        <source>1:1</source>
        <extracomment>Button: no vertical exaggeration</extracomment>
        <translation>1:1</translation>
    </message>
    <message>
        <source>True scale (1:1)</source>
        <translation>Wahrer Maßstab (1:1)</translation>
    </message>
    <message>
        <source>True scale: no vertical exaggeration</source>
        <translation>Wahrer Maßstab: keine Überhöhung</translation>
    </message>
</context>
<context>
    <name>marsview::ExaggerationSlider</name>
    <message>
        <source>Vertical exaggeration</source>
        <translation>Überhöhung</translation>
    </message>
    <message>
        <source>Vertical exaggeration (+ and −); the mark is at ×1</source>
        <translation>Überhöhung (+ und −); die Marke steht bei ×1</translation>
    </message>
</context>
<context>
    <name>marsview::FeaturePicker</name>
    <message>
        <source>Vector file</source>
        <translation>Vektordatei</translation>
    </message>
    <message>
        <source>Feature</source>
        <translation>Objekt</translation>
    </message>
</context>
<context>
    <name>marsview::FileOpening</name>
    <message>
        <source>&amp;Mars, Global (MOLA, 15 km)</source>
        <translation>&amp;Mars, global (MOLA, 15 km)</translation>
    </message>
    <message>
        <source>Mount &amp;St. Helens, Earth (30 m)</source>
        <translation>Mount &amp;St. Helens, Erde (30 m)</translation>
    </message>
    <message>
        <source>Elevation maps and projects (*.mvproj *.tif *.tiff *.lbl *.img *.cub *.hgt *.dem *.asc *.flt *.hdr *.bil *.nc *.cdf *.dt0 *.dt1 *.dt2 *.vrt *.xml *.zip)</source>
        <translation>Höhenkarten und Projekte (*.mvproj *.tif *.tiff *.lbl *.img *.cub *.hgt *.dem *.asc *.flt *.hdr *.bil *.nc *.cdf *.dt0 *.dt1 *.dt2 *.vrt *.xml *.zip)</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Open Map</source>
        <translation>Karte öffnen</translation>
    </message>
    <message>
        <source>Open Folder of Rasters</source>
        <translation>Ordner mit Rastern öffnen</translation>
    </message>
    <message>
        <source>Open Folder</source>
        <extracomment>On a button: open all rasters in a folder as one map</extracomment>
        <translation>Ordner öffnen</translation>
    </message>
</context>
<context>
    <name>marsview::FlyThroughDialog</name>
    <message>
        <source>&amp;Legend</source>
        <extracomment>In a recording</extracomment>
        <translation>&amp;Legende</translation>
    </message>
    <message>
        <source>L&amp;abels and lines on the map</source>
        <extracomment>In a recording: names of places, graticule, measurements</extracomment>
        <translation>&amp;Beschriftung und Linien auf der Karte</translation>
    </message>
    <message>
        <source>&amp;Record…</source>
        <translation>&amp;Aufzeichnen …</translation>
    </message>
    <message>
        <source>Fly-Through</source>
        <translation>Überflug</translation>
    </message>
    <message>
        <source>Position in the fly-through</source>
        <translation>Stelle im Überflug</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>&amp;Path</source>
        <translation>&amp;Weg</translation>
    </message>
    <message>
        <source>Slower at each view</source>
        <extracomment>Speed of a fly-through</extracomment>
        <translation>Bei jeder Ansicht langsamer</translation>
    </message>
    <message>
        <source>Constant</source>
        <extracomment>Speed of a fly-through</extracomment>
        <translation>Gleichmäßig</translation>
    </message>
    <message>
        <source>&amp;Speed</source>
        <translation>&amp;Geschwindigkeit</translation>
    </message>
    <message>
        <source> km</source>
        <extracomment>Kilometers, after a number</extracomment>
        <translation> km</translation>
    </message>
    <message>
        <source>&amp;Distance</source>
        <translation>&amp;Entfernung</translation>
    </message>
    <message>
        <source>0° looks straight down, 85° along the ground</source>
        <translation>0° blickt senkrecht nach unten, 85° am Boden entlang</translation>
    </message>
    <message>
        <source>&amp;Tilt</source>
        <translation>&amp;Neigung</translation>
    </message>
    <message>
        <source> s</source>
        <extracomment>Seconds, after a number</extracomment>
        <translation> s</translation>
    </message>
    <message>
        <source>D&amp;uration</source>
        <translation>&amp;Dauer</translation>
    </message>
    <message>
        <source>Video (MP4)</source>
        <extracomment>Format of a recording</extracomment>
        <translation>Video (MP4)</translation>
    </message>
    <message>
        <source>Numbered pictures (PNG)</source>
        <extracomment>Format of a recording</extracomment>
        <translation>Nummerierte Bilder (PNG)</translation>
    </message>
    <message>
        <source>&amp;Format</source>
        <translation>&amp;Format</translation>
    </message>
    <message>
        <source>Videos need the program ffmpeg, which is not installed.</source>
        <translation>Videos brauchen das Programm ffmpeg, das nicht installiert ist.</translation>
    </message>
    <message>
        <source>%1 × %2</source>
        <extracomment>Size of a picture: %1 × %2 pixels</extracomment>
        <translation>%1 × %2</translation>
    </message>
    <message>
        <source>Si&amp;ze</source>
        <translation>G&amp;röße</translation>
    </message>
    <message>
        <source>%1 fps</source>
        <extracomment>Frames per second</extracomment>
        <translation>%1 Bilder/s</translation>
    </message>
    <message>
        <source>Frame rat&amp;e</source>
        <translation>&amp;Bildrate</translation>
    </message>
    <message>
        <source>Include</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>Saved views</source>
        <translation>Gespeicherte Ansichten</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Play from here</source>
        <translation>Von hier abspielen</translation>
    </message>
    <message>
        <source>%1 / %2</source>
        <extracomment>Of a fly-through: %1 is the time that has passed, %2 all of it</extracomment>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>Save at least two views of this map with Ctrl+B, or measure a distance or a profile to fly along.</source>
        <translation>Speichern Sie mit Strg+B mindestens zwei Ansichten dieser Karte, oder messen Sie eine Entfernung oder ein Profil, um daran entlang zu fliegen.</translation>
    </message>
    <message>
        <source>%1 pictures</source>
        <translation>%1 Bilder</translation>
    </message>
    <message>
        <source>Record Fly-Through</source>
        <translation>Überflug aufzeichnen</translation>
    </message>
    <message>
        <source>MP4 video (*.mp4)</source>
        <translation>MP4-Video (*.mp4)</translation>
    </message>
    <message>
        <source>PNG pictures (*.png)</source>
        <translation>PNG-Bilder (*.png)</translation>
    </message>
    <message>
        <source>fly-through</source>
        <extracomment>The name of a recording&apos;s file, without its extension</extracomment>
        <translation>ueberflug</translation>
    </message>
</context>
<context>
    <name>marsview::FlyThroughRecorder</name>
    <message>
        <source>%1 exists already; choose another name or folder</source>
        <extracomment>%1 is a file</extracomment>
        <translation>%1 gibt es schon; wählen Sie einen anderen Namen oder Ordner</translation>
    </message>
    <message>
        <source>The program ffmpeg is not installed; install it, or save numbered pictures</source>
        <translation>Das Programm ffmpeg ist nicht installiert; installieren Sie es, oder speichern Sie nummerierte Bilder</translation>
    </message>
    <message>
        <source>The program ffmpeg cannot be started; save numbered pictures instead</source>
        <translation>Das Programm ffmpeg kann nicht gestartet werden; speichern Sie stattdessen nummerierte Bilder</translation>
    </message>
    <message>
        <source>Recording stopped, because another layer is on top now</source>
        <translation>Die Aufzeichnung wurde beendet, weil jetzt ein anderer Layer oben liegt</translation>
    </message>
    <message>
        <source>%1: the video cannot be written (%2); choose another folder, or save numbered pictures</source>
        <extracomment>%1 is a file, %2 what ffmpeg says</extracomment>
        <translation>%1: Das Video kann nicht geschrieben werden (%2); wählen Sie einen anderen Ordner, oder speichern Sie nummerierte Bilder</translation>
    </message>
    <message>
        <source>%1: the video cannot be written; choose another folder</source>
        <extracomment>%1 is a file</extracomment>
        <translation>%1: Das Video kann nicht geschrieben werden; wählen Sie einen anderen Ordner</translation>
    </message>
</context>
<context>
    <name>marsview::FocusFrame</name>
    <message>
        <source>Keyboard focus</source>
        <translation>Tastaturfokus</translation>
    </message>
</context>
<context>
    <name>marsview::ForceMeter</name>
    <message>
        <source>Force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>Force of the terrain on the stylus</source>
        <translation>Kraft des Geländes auf den Stift</translation>
    </message>
    <message>
        <source>Force %1</source>
        <translation>Kraft %1</translation>
    </message>
</context>
<context>
    <name>marsview::GeoreferencingPanel</name>
    <message>
        <source>CRS</source>
        <translation>KBS</translation>
    </message>
    <message>
        <source>body</source>
        <translation>Himmelskörper</translation>
    </message>
    <message>
        <source>radii</source>
        <translation>Radien</translation>
    </message>
    <message>
        <source>geotransform</source>
        <translation>Geotransformation</translation>
    </message>
    <message>
        <source>elevation unit</source>
        <translation>Höheneinheit</translation>
    </message>
    <message>
        <source>scale</source>
        <translation>Skalierung</translation>
    </message>
    <message>
        <source>offset</source>
        <translation>Versatz</translation>
    </message>
    <message>
        <source>vertical datum</source>
        <translation>Höhenbezug</translation>
    </message>
    <message>
        <source>nodata</source>
        <translation>Nodata</translation>
    </message>
    <message>
        <source>Set &amp;Body, CRS…</source>
        <translation>&amp;Raumbezug festlegen …</translation>
    </message>
    <message>
        <source>Set what the file lacks or states wrongly; the file itself is never changed</source>
        <translation>Festlegen, was der Datei fehlt oder was sie falsch angibt; die Datei selbst wird nie geändert</translation>
    </message>
    <message>
        <source>No layer is open.</source>
        <translation>Kein Layer ist geöffnet.</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>Body</source>
        <translation>Himmelskörper</translation>
    </message>
    <message>
        <source>Radii</source>
        <extracomment>Radii of an ellipsoid</extracomment>
        <translation>Radien</translation>
    </message>
    <message>
        <source>%1 m, sphere</source>
        <translation>%1 m, Kugel</translation>
    </message>
    <message>
        <source>%1 m equatorial
%2 m polar</source>
        <translation>%1 m am Äquator
%2 m am Pol</translation>
    </message>
    <message>
        <source>unnamed</source>
        <translation>unbenannt</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>CRS definition (WKT)</source>
        <translation>KBS-Definition (WKT)</translation>
    </message>
    <message>
        <source>map units</source>
        <translation>Karteneinheiten</translation>
    </message>
    <message>
        <source>%1 × %2</source>
        <extracomment>The width and height of a pixel</extracomment>
        <translation>%1 × %2</translation>
    </message>
    <message>
        <source>%1° × %2°</source>
        <extracomment>The exact width and height of a pixel in degrees</extracomment>
        <translation>%1° × %2°</translation>
    </message>
    <message>
        <source>%1 × %2 m</source>
        <translation>%1 × %2 m</translation>
    </message>
    <message>
        <source>%1, assumed</source>
        <translation>%1, angenommen</translation>
    </message>
    <message>
        <source>Pixel size</source>
        <translation>Pixelgröße</translation>
    </message>
    <message>
        <source>%1 – %2</source>
        <extracomment>A range of map coordinates</extracomment>
        <translation>%1 – %2</translation>
    </message>
    <message>
        <source>Extent</source>
        <extracomment>The ranges of map coordinates</extracomment>
        <translation>Ausdehnung</translation>
    </message>
    <message>
        <source>x %1
y %2</source>
        <translation>x %1
y %2</translation>
    </message>
    <message>
        <source>Latitude (%1)</source>
        <extracomment>The kind of latitude in brackets</extracomment>
        <translation>Breite (%1)</translation>
    </message>
    <message>
        <source>Longitude</source>
        <translation>Länge</translation>
    </message>
    <message>
        <source>Geotransform</source>
        <translation>Geotransformation</translation>
    </message>
    <message>
        <source>%1, %2, %3
%4, %5, %6</source>
        <translation>%1, %2, %3
%4, %5, %6</translation>
    </message>
    <message>
        <source>Samples</source>
        <extracomment>%1 columns and %2 rows of samples, of type %3</extracomment>
        <translation>Abtastwerte</translation>
    </message>
    <message>
        <source>%1 × %2, %3</source>
        <translation>%1 × %2, %3</translation>
    </message>
    <message>
        <source>Elevations</source>
        <translation>Höhen</translation>
    </message>
    <message>
        <source>Elevation unit</source>
        <translation>Höheneinheit</translation>
    </message>
    <message>
        <source>Vertical datum</source>
        <translation>Höhenbezug</translation>
    </message>
    <message>
        <source>Scale, offset</source>
        <extracomment>How elevations follow from samples: %1 is the factor, %2 the offset, %3 their unit</extracomment>
        <translation>Skalierung, Versatz</translation>
    </message>
    <message>
        <source>%1, %2 %3</source>
        <translation>%1, %2 %3</translation>
    </message>
    <message>
        <source>Nodata</source>
        <translation>Nodata</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>Format</translation>
    </message>
    <message>
        <source>Set by you</source>
        <translation>Von Ihnen festgelegt</translation>
    </message>
</context>
<context>
    <name>marsview::GestureHint</name>
    <message>
        <source>First Steps</source>
        <translation>Erste Schritte</translation>
    </message>
    <message>
        <source>Move over the map</source>
        <translation>Bewegen Sie sich über die Karte</translation>
    </message>
    <message>
        <source>Close the Hint</source>
        <translation>Hinweis schließen</translation>
    </message>
    <message>
        <source>Close the hint (Esc); Help › Keys and Mouse lists everything</source>
        <translation>Hinweis schließen (Esc); Hilfe › Tastatur und Maus nennt alles</translation>
    </message>
    <message>
        <source>Drag</source>
        <translation>Ziehen</translation>
    </message>
    <message>
        <source>arrow keys</source>
        <translation>Pfeiltasten</translation>
    </message>
    <message>
        <source>move</source>
        <translation>verschieben</translation>
    </message>
    <message>
        <source>Right-drag</source>
        <translation>Rechts ziehen</translation>
    </message>
    <message>
        <source>Q, E, R, F</source>
        <translation>Q, E, R, F</translation>
    </message>
    <message>
        <source>turn and tilt</source>
        <translation>drehen und neigen</translation>
    </message>
    <message>
        <source>Wheel</source>
        <translation>Rad</translation>
    </message>
    <message>
        <source>Page Up/Down</source>
        <translation>Bild auf/ab</translation>
    </message>
    <message>
        <source>zoom</source>
        <translation>vergrößern</translation>
    </message>
    <message>
        <source>Double-click</source>
        <translation>Doppelklick</translation>
    </message>
    <message>
        <source>fly there</source>
        <translation>dorthin fliegen</translation>
    </message>
    <message>
        <source>%1 or %2</source>
        <extracomment>%1 is a gesture of the mouse, %2 keys with the same effect</extracomment>
        <translation>%1 oder %2</translation>
    </message>
    <message>
        <source>%1. %2: %3</source>
        <extracomment>A list for screen readers: %1 is the list so far, %2 a gesture, %3 its effect</extracomment>
        <translation>%1. %2: %3</translation>
    </message>
    <message>
        <source>Choose Touch (T) and drag to feel the terrain</source>
        <translation>Mit „Ertasten“ (T) das Gelände fühlen</translation>
    </message>
    <message>
        <source>%1. %2</source>
        <extracomment>A list that is read aloud: %1 is what comes before, %2 a sentence</extracomment>
        <translation>%1. %2</translation>
    </message>
    <message>
        <source>T, then drag</source>
        <extracomment>In the hint over the map: choose the tool by its key, then drag</extracomment>
        <translation>T, dann ziehen</translation>
    </message>
    <message>
        <source>feel the terrain</source>
        <extracomment>In the hint over the map: what a drag with the tool Touch does</extracomment>
        <translation>das Gelände spüren</translation>
    </message>
</context>
<context>
    <name>marsview::GlobeHandScene</name>
    <message>
        <source>Preparing the terrain for touch…</source>
        <translation>Das Gelände wird zum Ertasten vorbereitet …</translation>
    </message>
</context>
<context>
    <name>marsview::GlobeLabels</name>
    <message>
        <source>Names and graticule</source>
        <translation>Namen und Gradnetz</translation>
    </message>
</context>
<context>
    <name>marsview::GlobeMeshes</name>
    <message>
        <source>Of layers on top of each other, only the lowest may be larger than memory and have nodata</source>
        <translation>Von übereinanderliegenden Ebenen darf nur die unterste größer als der Speicher sein und Nodata enthalten</translation>
    </message>
</context>
<context>
    <name>marsview::GlobeOverlays</name>
    <message>
        <source>North
Pole</source>
        <extracomment>In the corner of the overview map around a pole; may have two short lines</extracomment>
        <translation>Nord-
pol</translation>
    </message>
    <message>
        <source>South
Pole</source>
        <extracomment>In the corner of the overview map around a pole; may have two short lines</extracomment>
        <translation>Süd-
pol</translation>
    </message>
    <message>
        <source>North pole</source>
        <extracomment>For screen readers: what the overview map shows</extracomment>
        <translation>Nordpol</translation>
    </message>
    <message>
        <source>South pole</source>
        <extracomment>For screen readers: what the overview map shows</extracomment>
        <translation>Südpol</translation>
    </message>
</context>
<context>
    <name>marsview::GlobeView</name>
    <message>
        <source>Globe</source>
        <translation>Globus</translation>
    </message>
    <message>
        <source>The terrain on its body; the status bar shows the position and elevation under the pointer, or in the middle while the keyboard is used</source>
        <translation>Das Gelände auf seinem Himmelskörper; die Statusleiste zeigt Position und Höhe unter dem Zeiger oder, während die Tastatur benutzt wird, in der Mitte</translation>
    </message>
    <message>
        <source>Placing the layer on its body…</source>
        <translation>Der Layer wird auf seinen Himmelskörper gelegt …</translation>
    </message>
    <message>
        <source>Blending the edges of layers…</source>
        <translation>Die Kanten von Layern werden überblendet …</translation>
    </message>
    <message>
        <source>Preparing the terrain for touch…</source>
        <translation>Das Gelände wird zum Ertasten vorbereitet …</translation>
    </message>
</context>
<context>
    <name>marsview::GoToDialog</name>
    <message>
        <source>x, y (%1)</source>
        <extracomment>How a coordinate is read: the order, then the CRS or the kind of latitude</extracomment>
        <translation>x, y (%1)</translation>
    </message>
    <message>
        <source>Latitude, longitude (%1)</source>
        <translation>Breite, Länge (%1)</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <extracomment>The extent of a map: %1 latitudes, %2 longitudes</extracomment>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>x %1 … %2, y %3 … %4</source>
        <extracomment>The range of map coordinates: x from %1 to %2, y from %3 to %4</extracomment>
        <translation>x %1 … %2, y %3 … %4</translation>
    </message>
    <message>
        <source>This place is outside the map, which covers %1.</source>
        <translation>Dieser Ort liegt außerhalb der Karte, die %1 abdeckt.</translation>
    </message>
    <message>
        <source>This place is outside all maps in the view.</source>
        <translation>Dieser Ort liegt außerhalb aller Karten der Ansicht.</translation>
    </message>
    <message>
        <source>Go to Place</source>
        <translation>Gehe zu Ort</translation>
    </message>
    <message>
        <source>How the coordinate is read</source>
        <translation>Wie die Koordinate gelesen wird</translation>
    </message>
    <message>
        <source>Name or coordinate</source>
        <translation>Name oder Koordinate</translation>
    </message>
    <message>
        <source>How the coordinate is understood</source>
        <translation>Wie die Koordinate verstanden wird</translation>
    </message>
    <message>
        <source>&amp;Place</source>
        <translation>&amp;Ort</translation>
    </message>
    <message>
        <source>&amp;Read as</source>
        <translation>&amp;Lesen als</translation>
    </message>
    <message>
        <source>&amp;Go</source>
        <translation>&amp;Hingehen</translation>
    </message>
    <message>
        <source>Two numbers, x and then y.</source>
        <translation>Zwei Zahlen, x und dann y.</translation>
    </message>
    <message>
        <source>Degrees, or degrees, minutes and seconds. Without letters, latitude is first and longitude is positive to the west.</source>
        <translation>Grad, oder Grad, Minuten und Sekunden. Ohne Buchstaben kommt die Breite zuerst, und die Länge zählt positiv nach Westen.</translation>
    </message>
    <message>
        <source>Degrees, or degrees, minutes and seconds. Without letters, latitude is first and longitude is positive to the east.</source>
        <translation>Grad, oder Grad, Minuten und Sekunden. Ohne Buchstaben kommt die Breite zuerst, und die Länge zählt positiv nach Osten.</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <extracomment>A place: its name, then its kind and size</extracomment>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <extracomment>%1 is a position, %2 the CRS or the kind of latitude</extracomment>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>No elevation there</source>
        <translation>Dort gibt es keine Höhe</translation>
    </message>
    <message>
        <source>≈ %1</source>
        <extracomment>An elevation that is not exact yet</extracomment>
        <translation>≈ %1</translation>
    </message>
    <message>
        <source>Elevation %1</source>
        <extracomment>%1 is an elevation</extracomment>
        <translation>Höhe %1</translation>
    </message>
</context>
<context>
    <name>marsview::GuideWindow</name>
    <message>
        <source>User Guide</source>
        <translation>Benutzerhandbuch</translation>
    </message>
    <message>
        <source>Search the guide</source>
        <translation>Im Handbuch suchen</translation>
    </message>
    <message>
        <source>Pages</source>
        <translation>Seiten</translation>
    </message>
    <message>
        <source>Page</source>
        <translation>Seite</translation>
    </message>
    <message numerus="yes">
        <source>%Ln match(es)</source>
        <extracomment>How often the text that is searched for stands in the guide</extracomment>
        <translation>
            <numerusform>%Ln Treffer</numerusform>
            <numerusform>%Ln Treffer</numerusform>
        </translation>
    </message>
    <message>
        <source>Not found</source>
        <translation>Nicht gefunden</translation>
    </message>
</context>
<context>
    <name>marsview::HandPointer</name>
    <message>
        <source>The arrow points to the stylus</source>
        <translation>Der Pfeil zeigt auf den Stift</translation>
    </message>
    <message>
        <source>The stylus is to the right of the picture</source>
        <translation>Der Stift ist rechts vom Bild</translation>
    </message>
    <message>
        <source>The stylus is to the left of the picture</source>
        <translation>Der Stift ist links vom Bild</translation>
    </message>
    <message>
        <source>The stylus is below the picture</source>
        <translation>Der Stift ist unter dem Bild</translation>
    </message>
    <message>
        <source>The stylus is above the picture</source>
        <translation>Der Stift ist über dem Bild</translation>
    </message>
</context>
<context>
    <name>marsview::HapticsCommands</name>
    <message>
        <source>Cannot Record</source>
        <translation>Aufzeichnen ist nicht möglich</translation>
    </message>
    <message>
        <source>Cannot Save Diagnostic Log</source>
        <translation>Das Diagnoseprotokoll kann nicht gespeichert werden</translation>
    </message>
    <message>
        <source>Stop &amp;Recording Touch</source>
        <translation>Auf&amp;zeichnung anhalten</translation>
    </message>
    <message>
        <source>&amp;Record Touch…</source>
        <translation>Berührung auf&amp;zeichnen …</translation>
    </message>
</context>
<context>
    <name>marsview::HapticsController</name>
    <message>
        <source>The replay has ended: another scene is shown</source>
        <translation>Die Wiedergabe ist beendet: Eine andere Szene wird gezeigt</translation>
    </message>
    <message>
        <source>%1 was recorded on the flat map. Choose View › Scene › Flat Map to replay it</source>
        <extracomment>%1 is a file</extracomment>
        <translation>%1 wurde auf der ebenen Karte aufgezeichnet. Wählen Sie Ansicht › Szene › Ebene Karte, um es wiederzugeben</translation>
    </message>
    <message>
        <source>%1 was recorded on the globe. Choose View › Scene › Globe to replay it</source>
        <extracomment>%1 is a file</extracomment>
        <translation>%1 wurde auf dem Globus aufgezeichnet. Wählen Sie Ansicht › Szene › Globus, um es wiederzugeben</translation>
    </message>
    <message>
        <source>Nothing to touch here: the layer is not held in memory</source>
        <translation>Hier ist nichts zu ertasten: Die Ebene liegt nicht im Speicher</translation>
    </message>
    <message>
        <source>Layers are touched one by one: %1</source>
        <extracomment>%1 is the reason</extracomment>
        <translation>Die Ebenen werden einzeln ertastet: %1</translation>
    </message>
</context>
<context>
    <name>marsview::HapticsPanel</name>
    <message>
        <source>Haptic devices</source>
        <translation>Haptische Geräte</translation>
    </message>
    <message>
        <source>Connection</source>
        <translation>Verbindung</translation>
    </message>
    <message>
        <source>Force on the stylus</source>
        <translation>Kraft auf den Stift</translation>
    </message>
    <message>
        <source>Touch state</source>
        <translation>Zustand der Berührung</translation>
    </message>
    <message>
        <source>Set Home Position</source>
        <translation>Grundstellung setzen</translation>
    </message>
    <message>
        <source>Move the arm to its home position first; positions are measured from there</source>
        <translation>Bewegen Sie den Arm zuerst in seine Grundstellung; von dort aus werden Positionen gemessen</translation>
    </message>
    <message>
        <source>Contact &amp;model</source>
        <translation>Kontakt&amp;modell</translation>
    </message>
    <message>
        <source>Contact model</source>
        <translation>Kontaktmodell</translation>
    </message>
    <message>
        <source>&amp;Walls at the edges</source>
        <translation>&amp;Wände an den Rändern</translation>
    </message>
    <message>
        <source>Keep the stylus where the device works best</source>
        <translation>Den Stift dort halten, wo das Gerät am besten arbeitet</translation>
    </message>
    <message>
        <source>Surface st&amp;iffness</source>
        <translation>&amp;Steifigkeit</translation>
    </message>
    <message>
        <source>Limit of the stiffness</source>
        <translation>Grenze der Steifigkeit</translation>
    </message>
    <message>
        <source>F&amp;orce scale</source>
        <translation>&amp;Kraftfaktor</translation>
    </message>
    <message>
        <source>Record the motion of the stylus on this map in a file</source>
        <translation>Die Bewegung des Stifts auf dieser Karte in einer Datei aufzeichnen</translation>
    </message>
    <message>
        <source>Replayed</source>
        <translation>Abgespielt</translation>
    </message>
    <message>
        <source>Save Diagnostic &amp;Log…</source>
        <translation>&amp;Protokoll speichern …</translation>
    </message>
    <message>
        <source>Save the last ten seconds of the device, tick by tick, for troubleshooting</source>
        <translation>Die letzten zehn Sekunden des Geräts Takt für Takt speichern, zur Fehlersuche</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>&amp;Connect</source>
        <translation>&amp;Verbinden</translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation>&amp;Abbrechen</translation>
    </message>
    <message>
        <source>Dis&amp;connect</source>
        <translation>&amp;Trennen</translation>
    </message>
    <message>
        <source>No device is connected.</source>
        <translation>Kein Gerät ist verbunden.</translation>
    </message>
    <message>
        <source>Connecting to %1…</source>
        <extracomment>%1 names a device</extracomment>
        <translation>Verbindung zu %1 …</translation>
    </message>
    <message>
        <source>Replaying %1</source>
        <translation>%1 wird abgespielt</translation>
    </message>
    <message>
        <source>%1, up to %2</source>
        <extracomment>%1 is a device, %2 a force</extracomment>
        <translation>%1, bis zu %2</translation>
    </message>
    <message>
        <source>%1 N</source>
        <extracomment>A force in newtons</extracomment>
        <translation>%1 N</translation>
    </message>
    <message>
        <source>Share of the computed force that the device renders</source>
        <translation>Anteil der berechneten Kraft, den das Gerät ausübt</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>%1 N/m</source>
        <extracomment>Newtons per meter</extracomment>
        <translation>%1 N/m</translation>
    </message>
    <message>
        <source>The mark is the limit of the device: %1</source>
        <translation>Die Marke ist die Grenze des Geräts: %1</translation>
    </message>
    <message>
        <source>Surface stiffness</source>
        <translation>Steifigkeit der Oberfläche</translation>
    </message>
    <message>
        <source>Resume Forces</source>
        <translation>Kräfte einschalten</translation>
    </message>
    <message>
        <source>Emergency &amp;Stop</source>
        <translation>&amp;Notaus</translation>
    </message>
    <message>
        <source>Switch forces on again; they ramp up smoothly</source>
        <translation>Kräfte wieder einschalten; sie steigen sanft an</translation>
    </message>
    <message>
        <source>Switch all forces off at once (Ctrl+. or Pause, in any window)</source>
        <translation>Alle Kräfte sofort abschalten (Strg+. oder Pause, in jedem Fenster)</translation>
    </message>
    <message>
        <source>%1 when recorded</source>
        <translation>%1 bei der Aufzeichnung</translation>
    </message>
    <message>
        <source>No force recorded</source>
        <translation>Keine Kraft aufgezeichnet</translation>
    </message>
    <message>
        <source>Force off: %1</source>
        <extracomment>%1 is the device&apos;s error</extracomment>
        <translation>Kraft aus: %1</translation>
    </message>
    <message>
        <source>Replaying</source>
        <translation>Wird abgespielt</translation>
    </message>
    <message>
        <source>At the edge of the map</source>
        <translation>Am Rand der Karte</translation>
    </message>
    <message>
        <source>S&amp;top</source>
        <translation>An&amp;halten</translation>
    </message>
    <message>
        <source>&amp;Record…</source>
        <translation>&amp;Aufzeichnen …</translation>
    </message>
    <message>
        <source>Stop Re&amp;play</source>
        <translation>Abspielen anhal&amp;ten</translation>
    </message>
    <message>
        <source>Re&amp;play…</source>
        <translation>Ab&amp;spielen …</translation>
    </message>
    <message>
        <source>End the replay; the camera returns to where it was</source>
        <translation>Das Abspielen beenden; die Kamera kehrt zurück, wo sie war</translation>
    </message>
    <message>
        <source>Play back a recording on this map in place of a device</source>
        <translation>Eine Aufzeichnung auf dieser Karte anstelle eines Geräts abspielen</translation>
    </message>
    <message>
        <source>Recording into %1</source>
        <extracomment>%1 is a file</extracomment>
        <translation>Wird in %1 aufgezeichnet</translation>
    </message>
    <message>
        <source>Record Touch</source>
        <translation>Berührung aufzeichnen</translation>
    </message>
    <message>
        <source>Touch recording (*.csv)</source>
        <translation>Aufgezeichnete Berührung (*.csv)</translation>
    </message>
    <message>
        <source>touch</source>
        <translation>beruehrung</translation>
    </message>
    <message>
        <source>Nothing to save yet</source>
        <translation>Noch nichts zu speichern</translation>
    </message>
    <message>
        <source>Save Diagnostic Log</source>
        <translation>Diagnoseprotokoll speichern</translation>
    </message>
    <message>
        <source>Diagnostic log (*.csv)</source>
        <translation>Diagnoseprotokoll (*.csv)</translation>
    </message>
    <message>
        <source>log</source>
        <translation>protokoll</translation>
    </message>
    <message>
        <source>Replay Touch</source>
        <translation>Berührung abspielen</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>%1, not available: %2</source>
        <extracomment>A device that cannot be used, read aloud; %2 says why</extracomment>
        <translation>%1, nicht verfügbar: %2</translation>
    </message>
    <message>
        <source>Details: %1</source>
        <extracomment>%1 is what the system reported</extracomment>
        <translation>Einzelheiten: %1</translation>
    </message>
    <message>
        <source>Limited to %1</source>
        <translation>Begrenzt auf %1</translation>
    </message>
    <message>
        <source>Device limit: %1</source>
        <translation>Grenze des Geräts: %1</translation>
    </message>
</context>
<context>
    <name>marsview::HypsometryPlot</name>
    <message>
        <source>Hypsometry</source>
        <translation>Hypsometrie</translation>
    </message>
    <message>
        <source>The up and down arrow keys read the share of the area above an elevation</source>
        <translation>Die Pfeiltasten nach oben und unten lesen den Anteil der Fläche über einer Höhe ab</translation>
    </message>
    <message>
        <source>Bars: area (km²)</source>
        <translation>Balken: Fläche (km²)</translation>
    </message>
    <message>
        <source>Bars: area (m²)</source>
        <translation>Balken: Fläche (m²)</translation>
    </message>
    <message>
        <source>Line: share of the area above</source>
        <translation>Linie: Anteil der Fläche darüber</translation>
    </message>
    <message>
        <source>Elevation (%1), approximate</source>
        <translation>Höhe (%1), Näherung</translation>
    </message>
    <message>
        <source>Elevation (%1)</source>
        <translation>Höhe (%1)</translation>
    </message>
    <message>
        <source>%1 above %2</source>
        <extracomment>%1 is a share of the area in percent, %2 an elevation</extracomment>
        <translation>%1 über %2</translation>
    </message>
</context>
<context>
    <name>marsview::IntervalDialog</name>
    <message>
        <source> m</source>
        <extracomment>Meters, after a number</extracomment>
        <translation> m</translation>
    </message>
    <message>
        <source>Automatic</source>
        <extracomment>In place of a contour interval of 0: it follows the view</extracomment>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Enter 0 for an interval that follows the view</source>
        <translation>Geben Sie 0 ein, damit sich die Äquidistanz nach der Ansicht richtet</translation>
    </message>
    <message>
        <source>&amp;Interval between contour lines</source>
        <translation>&amp;Abstand zwischen Höhenlinien</translation>
    </message>
    <message>
        <source>Enter an interval from %1 m to %2 m, or 0 for automatic.</source>
        <translation>Geben Sie einen Abstand von %1 m bis %2 m ein oder 0 für einen automatischen.</translation>
    </message>
    <message>
        <source>Enter an interval from %1 m to %2 m.</source>
        <translation>Geben Sie einen Abstand von %1 m bis %2 m ein.</translation>
    </message>
</context>
<context>
    <name>marsview::KeysDialog</name>
    <message>
        <source>%1 or %2</source>
        <extracomment>Two keys for the same</extracomment>
        <translation>%1 oder %2</translation>
    </message>
    <message>
        <source>Keys and Mouse</source>
        <translation>Tastatur und Maus</translation>
    </message>
    <message>
        <source>Keys and gestures</source>
        <translation>Tastatur und Gesten</translation>
    </message>
    <message>
        <source>Mouse</source>
        <translation>Maus</translation>
    </message>
    <message>
        <source>Space held</source>
        <translation>Leertaste gehalten</translation>
    </message>
    <message>
        <source>Grab: pan in contact, zoom in the air</source>
        <translation>Greifen: bei Kontakt verschieben, in der Luft vergrößern</translation>
    </message>
    <message>
        <source>Drop files</source>
        <translation>Dateien ablegen</translation>
    </message>
    <message>
        <source>Open them</source>
        <translation>Öffnet sie</translation>
    </message>
    <message>
        <source>SpaceMouse cap</source>
        <translation>SpaceMouse-Kappe</translation>
    </message>
    <message>
        <source>Pan, zoom, turn and tilt</source>
        <translation>Verschieben, vergrößern, drehen und neigen</translation>
    </message>
    <message>
        <source>SpaceMouse button 1</source>
        <translation>SpaceMouse-Taste 1</translation>
    </message>
    <message>
        <source>Show the whole map</source>
        <translation>Die ganze Karte zeigen</translation>
    </message>
    <message>
        <source>Measure and Annotate</source>
        <extracomment>A group of keys: those of the tools Measure and Annotate</extracomment>
        <translation>Messen und Anmerken</translation>
    </message>
    <message>
        <source>Place a point at the pointer or crosshair</source>
        <translation>Einen Punkt am Zeiger oder Fadenkreuz setzen</translation>
    </message>
    <message>
        <source>%1 again</source>
        <extracomment>%1 is a key</extracomment>
        <translation>%1 erneut</translation>
    </message>
    <message>
        <source>In the same place: finish</source>
        <translation>Am selben Ort: abschließen</translation>
    </message>
    <message>
        <source>Remove the last point, or the one under the pointer</source>
        <translation>Den letzten Punkt oder den unter dem Zeiger entfernen</translation>
    </message>
    <message>
        <source>Remove the selected item, or the point under the pointer</source>
        <translation>Das ausgewählte Objekt oder den Punkt unter dem Zeiger entfernen</translation>
    </message>
    <message>
        <source>Discard an unfinished item, or deselect</source>
        <translation>Ein unfertiges Objekt verwerfen oder die Auswahl aufheben</translation>
    </message>
    <message>
        <source>Drag a point</source>
        <translation>Punkt ziehen</translation>
    </message>
    <message>
        <source>Move it</source>
        <translation>Verschieben</translation>
    </message>
    <message>
        <source>Drag a line</source>
        <translation>Linie ziehen</translation>
    </message>
    <message>
        <source>Insert a point</source>
        <translation>Einen Punkt einfügen</translation>
    </message>
</context>
<context>
    <name>marsview::LargeMapsPage</name>
    <message>
        <source>&amp;Empty…</source>
        <translation>&amp;Leeren …</translation>
    </message>
    <message>
        <source> MB</source>
        <extracomment>Megabytes, after a number</extracomment>
        <translation> MB</translation>
    </message>
    <message>
        <source>Memory for tiles of large maps</source>
        <translation>Speicher für Kacheln großer Karten</translation>
    </message>
    <message>
        <source>Tiles of large maps that are shown or touched stay in memory up to this size; the least recently used are evicted first</source>
        <translation>Kacheln großer Karten, die gezeigt oder ertastet werden, bleiben bis zu dieser Größe im Speicher; die am längsten nicht benutzten werden zuerst entfernt</translation>
    </message>
    <message>
        <source>Folder of prepared maps</source>
        <translation>Ordner der vorbereiteten Karten</translation>
    </message>
    <message>
        <source>&amp;Choose…</source>
        <translation>&amp;Wählen …</translation>
    </message>
    <message>
        <source>O&amp;pen</source>
        <translation>Ö&amp;ffnen</translation>
    </message>
    <message>
        <source>Show the folder in the file manager</source>
        <translation>Den Ordner in der Dateiverwaltung zeigen</translation>
    </message>
    <message>
        <source> GB</source>
        <extracomment>Gigabytes, after a number</extracomment>
        <translation> GB</translation>
    </message>
    <message>
        <source>Maximum size of prepared maps</source>
        <translation>Höchstgröße der vorbereiteten Karten</translation>
    </message>
    <message>
        <source>When a new map needs room, the least recently used maps are removed</source>
        <translation>Braucht eine neue Karte Platz, werden die am längsten nicht benutzten Karten entfernt</translation>
    </message>
    <message>
        <source>Prepared maps</source>
        <translation>Vorbereitete Karten</translation>
    </message>
    <message>
        <source>Prepared map</source>
        <translation>Vorbereitete Karte</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Last used</source>
        <translation>Zuletzt benutzt</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Remove &amp;All…</source>
        <translation>&amp;Alle entfernen …</translation>
    </message>
    <message>
        <source>&amp;Maximum size</source>
        <translation>&amp;Höchstgröße</translation>
    </message>
    <message>
        <source>Folder of tiles from servers</source>
        <translation>Ordner der Kacheln von Servern</translation>
    </message>
    <message>
        <source>Automatic (%1)</source>
        <extracomment>In place of the number 0: a usual amount of memory %1 is a number of megabytes
----------
In place of the number 0: a usual bound; %1 is a size</extracomment>
        <translation>Automatisch (%1)</translation>
    </message>
    <message>
        <source>Maximum size of tiles from servers</source>
        <translation>Höchstgröße der Kacheln von Servern</translation>
    </message>
    <message>
        <source>When new tiles need room, the least recently used tiles are removed</source>
        <translation>Brauchen neue Kacheln Platz, werden die am längsten nicht benutzten Kacheln entfernt</translation>
    </message>
    <message>
        <source>Tiles from servers</source>
        <translation>Kacheln von Servern</translation>
    </message>
    <message>
        <source>Ma&amp;ximum size</source>
        <translation>Höchst&amp;größe</translation>
    </message>
    <message>
        <source>Folder of Prepared Maps</source>
        <translation>Ordner der vorbereiteten Karten</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>%1 (in use)</source>
        <extracomment>Of a prepared map that some window shows</extracomment>
        <translation>%1 (in Gebrauch)</translation>
    </message>
    <message>
        <source>Nothing has been prepared here.</source>
        <translation>Hier wurde nichts vorbereitet.</translation>
    </message>
    <message>
        <source>One map, %1</source>
        <translation>Eine Karte, %1</translation>
    </message>
    <message numerus="yes">
        <source>%n maps, %1</source>
        <translation>
            <numerusform>%n Karte, %1</numerusform>
            <numerusform>%n Karten, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Remove All Prepared Maps</source>
        <translation>Alle vorbereiteten Karten entfernen</translation>
    </message>
    <message>
        <source>Remove all prepared maps? The maps themselves stay; they are prepared again when they are opened, which takes minutes.</source>
        <translation>Alle vorbereiteten Karten entfernen? Die Karten selbst bleiben; sie werden beim Öffnen neu vorbereitet, was Minuten dauert.</translation>
    </message>
    <message>
        <source>Remove &amp;All</source>
        <translation>&amp;Alle entfernen</translation>
    </message>
    <message>
        <source>Calculating…</source>
        <translation>Wird berechnet …</translation>
    </message>
    <message>
        <source>No tiles are stored here.</source>
        <translation>Hier sind keine Kacheln gespeichert.</translation>
    </message>
    <message>
        <source>One tile, %1</source>
        <translation>Eine Kachel, %1</translation>
    </message>
    <message numerus="yes">
        <source>%n tiles, %1</source>
        <translation>
            <numerusform>%n Kachel, %1</numerusform>
            <numerusform>%n Kacheln, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Remove Tiles from Servers</source>
        <translation>Kacheln von Servern entfernen</translation>
    </message>
    <message>
        <source>Remove all downloaded tiles? They are downloaded again when they are viewed or touched.</source>
        <translation>Alle geladenen Kacheln entfernen? Sie werden neu geladen, wenn sie gezeigt oder ertastet werden.</translation>
    </message>
    <message>
        <source>Removing…</source>
        <translation>Wird entfernt …</translation>
    </message>
    <message>
        <source>%1 MB</source>
        <translation>%1 MB</translation>
    </message>
</context>
<context>
    <name>marsview::LayerDelegate</name>
    <message>
        <source>Show</source>
        <extracomment>On a button in the row of a layer that the view does not show</extracomment>
        <translation>Zeigen</translation>
    </message>
</context>
<context>
    <name>marsview::LayerModel</name>
    <message>
        <source>Hidden: it %1</source>
        <extracomment>Why a layer is not shown: %1 is a reason, such as &quot;has samples beyond a pole&quot;</extracomment>
        <translation>Verborgen: Er %1</translation>
    </message>
    <message>
        <source>Hidden: on %1; the view shows %2</source>
        <extracomment>Why a layer is not shown: %1 is its body, %2 the body that the view shows</extracomment>
        <translation>Verborgen: Himmelskörper %1, Ansicht: %2</translation>
    </message>
    <message>
        <source>Hidden: its CRS, %1, is not that of the view</source>
        <extracomment>Why a layer is not shown: %1 is its coordinate system</extracomment>
        <translation>Verborgen: Sein KBS, %1, ist nicht das der Ansicht</translation>
    </message>
    <message>
        <source>Hidden: the view shows %1, which has no CRS</source>
        <translation>Verborgen: Die Ansicht zeigt %1 ohne KBS</translation>
    </message>
    <message>
        <source>Hidden: no CRS, so its position in the view is unknown</source>
        <translation>Verborgen: kein KBS, darum ist seine Lage in der Ansicht unbekannt</translation>
    </message>
    <message>
        <source>Unknown body</source>
        <extracomment>Above the layers without a known body</extracomment>
        <translation>Unbekannter Himmelskörper</translation>
    </message>
    <message>
        <source>%1 × %2</source>
        <extracomment>Columns and rows of a map</extracomment>
        <translation>%1 × %2</translation>
    </message>
    <message>
        <source>%1.
%2</source>
        <extracomment>Tool tip: %1 says why a layer is not shown, %2 is its file</extracomment>
        <translation>%1.
%2</translation>
    </message>
    <message>
        <source>%1. Click Show to show it instead.
%2</source>
        <extracomment>Tool tip: %1 says why a layer is not shown, %2 is its file</extracomment>
        <translation>%1. Klicken Sie auf Zeigen, um ihn stattdessen zu sehen.
%2</translation>
    </message>
    <message>
        <source>%1. Press Space to show it</source>
        <translation>%1. Die Leertaste zeigt ihn</translation>
    </message>
    <message>
        <source>hidden</source>
        <translation>verborgen</translation>
    </message>
    <message>
        <source>shown as a preview</source>
        <translation>als Vorschau gezeigt</translation>
    </message>
    <message>
        <source>shown</source>
        <translation>gezeigt</translation>
    </message>
    <message>
        <source>%1, %2, %3 samples, elevations %4</source>
        <extracomment>For screen readers: name, state, columns × rows and range of elevations of a layer</extracomment>
        <translation>%1, %2, %3 Abtastwerte, Höhen %4</translation>
    </message>
    <message>
        <source>Preview</source>
        <extracomment>Of a layer: a smaller version of the map is shown</extracomment>
        <translation>Vorschau</translation>
    </message>
</context>
<context>
    <name>marsview::LayersPanel</name>
    <message>
        <source>Layers, topmost first</source>
        <translation>Layer, oberster zuerst</translation>
    </message>
    <message>
        <source>No layers.
Drop a DEM here or press %1 to open one.</source>
        <translation>Keine Layer.
Legen Sie hier ein Geländemodell ab, oder öffnen Sie eines mit %1.</translation>
    </message>
    <message>
        <source>Missing: %1.
Locate or remove what is missing in the notice above the map.</source>
        <extracomment>%1 are the names of layers of a project</extracomment>
        <translation>Es fehlen: %1.
Was fehlt, lässt sich im Hinweis über der Karte suchen oder entfernen.</translation>
    </message>
    <message>
        <source>Opening…</source>
        <extracomment>The layers of a project are being opened</extracomment>
        <translation>Wird geöffnet …</translation>
    </message>
    <message>
        <source>Color ramp of the active layer</source>
        <translation>Farbskala des aktiven Layers</translation>
    </message>
    <message>
        <source>Automatic</source>
        <extracomment>A color ramp: the one that suits the map&apos;s body</extracomment>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Color &amp;ramp</source>
        <translation>Farb&amp;skala</translation>
    </message>
    <message>
        <source>&amp;Blend edges over</source>
        <translation>&amp;Weicher Rand</translation>
    </message>
    <message>
        <source>Cells over which the edges of the active layer are blended</source>
        <translation>Zellen, über die die Kanten des aktiven Layers überblendet werden</translation>
    </message>
    <message>
        <source>Off</source>
        <extracomment>Edges are not blended</extracomment>
        <translation>Aus</translation>
    </message>
    <message>
        <source> cells</source>
        <extracomment>Follows a number of cells of a grid</extracomment>
        <translation> Zellen</translation>
    </message>
    <message>
        <source>Where this layer ends, it goes smoothly into the layers below it: in the picture and for touch. Elevations that are read stay those of the layer.</source>
        <translation>Wo dieser Layer endet, geht er stufenlos in die Layer darunter über: im Bild und beim Ertasten. Abgelesene Höhen bleiben die des Layers.</translation>
    </message>
</context>
<context>
    <name>marsview::Legend</name>
    <message>
        <source>Legend</source>
        <translation>Legende</translation>
    </message>
    <message>
        <source>What the colors and lines on the map mean</source>
        <translation>Was die Farben und Linien der Karte bedeuten</translation>
    </message>
    <message>
        <source>Slope (°)</source>
        <extracomment>Title of the legend of slopes in degrees</extracomment>
        <translation>Neigung (°)</translation>
    </message>
    <message>
        <source>Elevation (%1)</source>
        <extracomment>Title of the legend of elevations; %1 is the unit of its numbers</extracomment>
        <translation>Höhe (%1)</translation>
    </message>
    <message>
        <source>Contours %1</source>
        <extracomment>%1 is the difference in height from one contour line to the next, for example &quot;200 m&quot;</extracomment>
        <translation>Höhenlinien %1</translation>
    </message>
    <message>
        <source>Legend: slope from %1° to %2°</source>
        <translation>Legende: Neigung von %1° bis %2°</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <extracomment>%1 is an elevation, %2 its unit</extracomment>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>Legend: elevation from %1 to %2</source>
        <extracomment>%1 and %2 are elevations</extracomment>
        <translation>Legende: Höhe von %1 bis %2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <extracomment>%1 describes a legend, %2 is what its elevations refer to, such as &quot;areoid&quot;</extracomment>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>%1, layer %2</source>
        <extracomment>%1 describes the legend of a layer, %2 is the layer</extracomment>
        <translation>%1, Layer %2</translation>
    </message>
    <message>
        <source>%1, lowest %2</source>
        <extracomment>%1 describes a legend, %2 is an elevation below its lower end</extracomment>
        <translation>%1, tiefster Punkt %2</translation>
    </message>
    <message>
        <source>%1, highest %2</source>
        <extracomment>%1 describes a legend, %2 is an elevation above its upper end</extracomment>
        <translation>%1, höchster Punkt %2</translation>
    </message>
    <message>
        <source>Legend: contour lines every %1</source>
        <translation>Legende: Höhenlinien alle %1</translation>
    </message>
    <message>
        <source>%1, contour lines every %2</source>
        <extracomment>%1 describes the colors of a legend, %2 is the interval of contours</extracomment>
        <translation>%1, Höhenlinien alle %2</translation>
    </message>
</context>
<context>
    <name>marsview::LightPad</name>
    <message>
        <source>Direction of the light</source>
        <translation>Richtung des Lichts</translation>
    </message>
    <message>
        <source>Left and right turn the light, up and down raise and lower it</source>
        <translation>Links und rechts drehen das Licht, auf und ab heben und senken es</translation>
    </message>
    <message>
        <source>N</source>
        <extracomment>North, on a compass</extracomment>
        <translation>N</translation>
    </message>
</context>
<context>
    <name>marsview::LightPopup</name>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>Azimuth of the light, clockwise from north</source>
        <translation>Azimut des Lichts, im Uhrzeigersinn von Norden</translation>
    </message>
    <message>
        <source>Altitude of the light above the horizon</source>
        <translation>Höhe des Lichts über dem Horizont</translation>
    </message>
    <message>
        <source>A&amp;zimuth</source>
        <translation>A&amp;zimut</translation>
    </message>
    <message>
        <source>A&amp;ltitude</source>
        <translation>&amp;Höhe</translation>
    </message>
    <message>
        <source>&amp;Reset</source>
        <extracomment>Resets the light to the north-west</extracomment>
        <translation>&amp;Zurücksetzen</translation>
    </message>
    <message>
        <source>Fixed in the &amp;view</source>
        <translation>Fest in der &amp;Ansicht</translation>
    </message>
    <message>
        <source>Fixed on the &amp;body</source>
        <translation>Fest am Himmels&amp;körper</translation>
    </message>
    <message>
        <source>The light turns with the camera: slopes look the same everywhere</source>
        <translation>Das Licht folgt der Kamera: Hänge sehen überall gleich aus</translation>
    </message>
    <message>
        <source>The sun stands over a place of the body, whose other side is dark. Moving the camera does not change the light.</source>
        <translation>Die Sonne steht über einem Ort des Himmelskörpers, dessen andere Seite dunkel ist. Bewegungen der Kamera ändern das Licht nicht.</translation>
    </message>
    <message>
        <source>Where the light comes from. Fixed in the view, it has an azimuth and an altitude at the center of the picture. Fixed on the body, the sun stands over the subsolar point, and the terminator separates day and night. Mountains cast no shadows.</source>
        <translation>Woher das Licht kommt. Fest in der Ansicht hat es in der Bildmitte einen Azimut und eine Höhe. Fest am Himmelskörper steht die Sonne über dem subsolaren Punkt, und der Terminator trennt Tag und Nacht. Berge werfen keine Schatten.</translation>
    </message>
    <message>
        <source>The flat map has the light of the view. The light of the globe is fixed on the body.</source>
        <translation>Die flache Karte hat das Licht der Ansicht. Das Licht des Globus ist fest am Himmelskörper.</translation>
    </message>
    <message>
        <source>The flat map has the light of the view. Show the globe to fix the light on the body.</source>
        <translation>Die flache Karte hat das Licht der Ansicht. Auf dem Globus kann das Licht fest am Himmelskörper sein.</translation>
    </message>
</context>
<context>
    <name>marsview::LoadStatus</name>
    <message>
        <source>Loading</source>
        <translation>Lädt</translation>
    </message>
    <message>
        <source>Progress of loading</source>
        <translation>Fortschritt beim Laden</translation>
    </message>
    <message>
        <source>Cancel Loading</source>
        <translation>Laden abbrechen</translation>
    </message>
    <message>
        <source>%1 (%2 of %3)</source>
        <translation>%1 (%2 von %3)</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <extracomment>In the status bar: %1 is a file</extracomment>
        <translation>%1 wird gelesen</translation>
    </message>
    <message>
        <source>Drawing %1</source>
        <translation>%1 wird gezeichnet</translation>
    </message>
    <message>
        <source>Writing %1</source>
        <extracomment>In the status bar: %1 is the file of a picture</extracomment>
        <translation>%1 wird geschrieben</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <extracomment>The share that is done and the time left: &quot;37 %, 4 min left&quot;</extracomment>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>Building overviews of %1: %2</source>
        <extracomment>In the status bar: %1 is a file, %2 the progress</extracomment>
        <translation>Übersichten von %1 werden erstellt: %2</translation>
    </message>
    <message numerus="yes">
        <source>%1
%n more waiting</source>
        <extracomment>Tool tip: %1 is a file, %n the number of maps whose turn is after it</extracomment>
        <translation>
            <numerusform>%1
%n weitere wartet</numerusform>
            <numerusform>%1
%n weitere warten</numerusform>
        </translation>
    </message>
    <message>
        <source>Cancel loading (Esc)</source>
        <translation>Laden abbrechen (Esc)</translation>
    </message>
    <message>
        <source>Cancel Saving</source>
        <translation>Speichern abbrechen</translation>
    </message>
    <message>
        <source>Cancel saving the picture (Esc)</source>
        <translation>Speichern des Bilds abbrechen (Esc)</translation>
    </message>
    <message>
        <source>Stop Building</source>
        <translation>Erstellen anhalten</translation>
    </message>
    <message>
        <source>Stop building overviews; it can be resumed later</source>
        <translation>Das Erstellen der Übersichten anhalten; es kann später fortgesetzt werden</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Cancel (Esc)</source>
        <translation>Abbrechen (Esc)</translation>
    </message>
</context>
<context>
    <name>marsview::LoopTimes</name>
    <message>
        <source>median %1 · 99.9 % %2 · longest %3</source>
        <extracomment>Durations: the median, the 99.9th percentile, the longest</extracomment>
        <translation>Median %1 · 99,9 % %2 · längste %3</translation>
    </message>
    <message>
        <source>Update time</source>
        <translation>Rechenzeit</translation>
    </message>
    <message>
        <source>Late wake-up</source>
        <translation>Verspätetes Aufwachen</translation>
    </message>
    <message>
        <source>Missed deadlines</source>
        <translation>Versäumte Fristen</translation>
    </message>
    <message>
        <source>Real-time scheduling</source>
        <translation>Echtzeitplanung</translation>
    </message>
    <message>
        <source>Since the connection: the median, the 99.9th percentile and the longest. The plot shows the last half minute from 1 µs to 10 ms: the median, and paler the longest.</source>
        <translation>Seit dem Verbinden: der Median, das 99,9. Perzentil und der längste Wert. Das Diagramm zeigt die letzte halbe Minute von 1 µs bis 10 ms: den Median und blasser den längsten Wert.</translation>
    </message>
    <message>
        <source>%1 of %2 deadlines missed</source>
        <extracomment>%1 and %2 are numbers</extracomment>
        <translation>%1 von %2 Fristen versäumt</translation>
    </message>
</context>
<context>
    <name>marsview::MainToolBar</name>
    <message>
        <source>Main Toolbar</source>
        <translation>Hauptwerkzeugleiste</translation>
    </message>
    <message>
        <source>Exaggeration</source>
        <translation>Überhöhung</translation>
    </message>
    <message>
        <source>Shading</source>
        <translation>Schattierung</translation>
    </message>
    <message>
        <source>What the terrain colors represent</source>
        <translation>Was die Farben des Geländes bedeuten</translation>
    </message>
    <message>
        <source>Colors</source>
        <extracomment>On a button: color ramps</extracomment>
        <translation>Farben</translation>
    </message>
    <message>
        <source>Color ramp of the active layer</source>
        <translation>Farbskala des aktiven Layers</translation>
    </message>
    <message>
        <source>Stretch</source>
        <extracomment>On a button: over which elevations the color ramp is spread</extracomment>
        <translation>Spreizung</translation>
    </message>
    <message>
        <source>Color stretch of the active layer</source>
        <translation>Farbspreizung des aktiven Layers</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>Direction of the light</source>
        <translation>Richtung des Lichts</translation>
    </message>
    <message>
        <source>Find a name</source>
        <translation>Namen suchen</translation>
    </message>
    <message>
        <source>Type the name of a place, for example a mountain or a crater</source>
        <translation>Geben Sie den Namen eines Orts ein, zum Beispiel eines Bergs oder Kraters</translation>
    </message>
    <message>
        <source>More Tools</source>
        <extracomment>The button that opens what the toolbar has no room for</extracomment>
        <translation>Weitere Werkzeuge</translation>
    </message>
    <message>
        <source>What to measure</source>
        <translation>Was gemessen wird</translation>
    </message>
    <message>
        <source>What to draw</source>
        <translation>Was gezeichnet wird</translation>
    </message>
    <message>
        <source>Chooses what the colors of the terrain represent: elevations with or without shading, the light alone, or slopes. Contour lines can be added.</source>
        <translation>Wählt, was die Farben des Geländes bedeuten: Höhen mit oder ohne Schattierung, nur das Licht oder die Neigung. Höhenlinien können dazukommen.</translation>
    </message>
    <message>
        <source>Chooses the color ramp of the active layer. The legend shows which color stands for which elevation.</source>
        <translation>Wählt die Farbskala des aktiven Layers. Die Legende zeigt, welche Farbe für welche Höhe steht.</translation>
    </message>
    <message>
        <source>Chooses the range over which the color ramp of the active layer is spread: the whole range, most elevations, those in the picture, or limits of your own.</source>
        <translation>Wählt den Bereich, über den die Farbskala des aktiven Layers gespreizt wird: den ganzen Bereich, die meisten Höhen, die Höhen im Bild oder eigene Grenzen.</translation>
    </message>
    <message>
        <source>Finds places of the body in the picture by their names. Type some letters, choose a name from the list or press Return, and the map flies there.</source>
        <translation>Findet Orte des gezeigten Himmelskörpers nach ihren Namen. Tippen Sie einige Buchstaben und wählen Sie einen Namen aus der Liste oder drücken Sie die Eingabetaste: Die Karte fliegt dorthin.</translation>
    </message>
</context>
<context>
    <name>marsview::MainWindow</name>
    <message>
        <source>MarsView</source>
        <extracomment>Window title: %1 is a project or a layer</extracomment>
        <translation>MarsView</translation>
    </message>
    <message>
        <source>%1 — MarsView</source>
        <translation>%1 — MarsView</translation>
    </message>
</context>
<context>
    <name>marsview::MapLabels</name>
    <message>
        <source>Names and graticule</source>
        <translation>Namen und Gradnetz</translation>
    </message>
</context>
<context>
    <name>marsview::MapMenu</name>
    <message>
        <source>Place on the map</source>
        <translation>Ort auf der Karte</translation>
    </message>
    <message>
        <source>&amp;Copy Coordinates</source>
        <translation>&amp;Koordinaten kopieren</translation>
    </message>
    <message>
        <source>&amp;Remove Pin</source>
        <translation>Markierung &amp;entfernen</translation>
    </message>
    <message>
        <source>Copy &amp;Elevation</source>
        <translation>&amp;Höhe kopieren</translation>
    </message>
    <message>
        <source>&amp;Fly Here</source>
        <translation>Hierhin &amp;fliegen</translation>
    </message>
    <message>
        <source>Measure &amp;Distance from Here</source>
        <translation>Von hier &amp;Entfernung messen</translation>
    </message>
    <message>
        <source>&amp;Add Annotation Here</source>
        <translation>Hier &amp;Anmerkung setzen</translation>
    </message>
    <message>
        <source>Ce&amp;nter Here</source>
        <translation>Hier &amp;zentrieren</translation>
    </message>
    <message>
        <source>&amp;What Is Here…</source>
        <translation>&amp;Was ist hier …</translation>
    </message>
</context>
<context>
    <name>marsview::MapOverlays</name>
    <message>
        <source>&amp;Overview Map</source>
        <translation>&amp;Übersichtskarte</translation>
    </message>
    <message>
        <source>&amp;Legend</source>
        <translation>&amp;Legende</translation>
    </message>
    <message>
        <source>&amp;Compass and Scale Bar</source>
        <translation>&amp;Kompass und Maßstabsbalken</translation>
    </message>
    <message>
        <source>N&amp;ames</source>
        <translation>N&amp;amen</translation>
    </message>
    <message>
        <source>Grat&amp;icule</source>
        <translation>Gra&amp;dnetz</translation>
    </message>
</context>
<context>
    <name>marsview::MeasureController</name>
    <message>
        <source>Remove All Measurements</source>
        <translation>Alle Messungen entfernen</translation>
    </message>
    <message>
        <source>Distance %1</source>
        <translation>Entfernung %1</translation>
    </message>
    <message>
        <source>Profile %1</source>
        <translation>Profil %1</translation>
    </message>
    <message>
        <source>Area %1</source>
        <translation>Fläche %1</translation>
    </message>
    <message>
        <source>Attitude %1</source>
        <extracomment>Strike and dip of a plane</extracomment>
        <translation>Lagerung %1</translation>
    </message>
    <message>
        <source>Crater %1</source>
        <translation>Krater %1</translation>
    </message>
    <message>
        <source>Point %1</source>
        <translation>Punkt %1</translation>
    </message>
</context>
<context>
    <name>marsview::MeasureList</name>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Layer</source>
        <translation>Layer</translation>
    </message>
    <message>
        <source>%1 (missing)</source>
        <extracomment>Of a layer of a project: its file cannot be opened</extracomment>
        <translation>%1 (fehlt)</translation>
    </message>
    <message>
        <source>removed</source>
        <extracomment>The layer on which a measurement was made</extracomment>
        <translation>entfernt</translation>
    </message>
    <message>
        <source>no result</source>
        <extracomment>In place of the figure of a measurement that failed, in a list</extracomment>
        <translation>kein Ergebnis</translation>
    </message>
</context>
<context>
    <name>marsview::MeasureMarks</name>
    <message>
        <source>Points of the measurements</source>
        <translation>Punkte der Messungen</translation>
    </message>
</context>
<context>
    <name>marsview::MeasurePanel</name>
    <message>
        <source>Save &amp;Table…</source>
        <translation>&amp;Tabelle speichern …</translation>
    </message>
    <message>
        <source>Save all measurements with their results as CSV or GeoPackage</source>
        <translation>Alle Messungen mit ihren Ergebnissen als CSV oder GeoPackage speichern</translation>
    </message>
    <message>
        <source>Results</source>
        <translation>Ergebnisse</translation>
    </message>
    <message>
        <source>Select all results</source>
        <translation>Alle Ergebnisse auswählen</translation>
    </message>
    <message>
        <source>&amp;Copy</source>
        <translation>&amp;Kopieren</translation>
    </message>
    <message>
        <source>Copy the results as text</source>
        <translation>Die Ergebnisse als Text kopieren</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Remove this measurement; Undo brings it back</source>
        <translation>Diese Messung entfernen; Rückgängig holt sie zurück</translation>
    </message>
    <message>
        <source>Vertical scale of the profile</source>
        <translation>Höhenmaßstab des Profils</translation>
    </message>
    <message>
        <source>How many times larger elevations are drawn than distances</source>
        <translation>Wie viel größer Höhen gezeichnet werden als Entfernungen</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Einpassen</translation>
    </message>
    <message>
        <source>Slope</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>Show the slope along the profile</source>
        <translation>Die Neigung entlang des Profils zeigen</translation>
    </message>
    <message>
        <source>Save Pro&amp;file…</source>
        <translation>Pro&amp;fil speichern …</translation>
    </message>
    <message>
        <source>Save the profile as CSV, PNG, SVG or PDF</source>
        <translation>Das Profil als CSV, PNG, SVG oder PDF speichern</translation>
    </message>
    <message>
        <source>Drag along the profile to measure a part of it.</source>
        <translation>Ziehen Sie entlang des Profils, um einen Teil davon zu messen.</translation>
    </message>
    <message>
        <source>&amp;Vertical scale</source>
        <translation>&amp;Höhenmaßstab</translation>
    </message>
    <message>
        <source>New: %1</source>
        <extracomment>%1 is a kind of measurement, as in the Measure menu</extracomment>
        <translation>Neu: %1</translation>
    </message>
    <message>
        <source>Press M, or choose what to measure.</source>
        <translation>Drücken Sie M, oder wählen Sie, was Sie messen wollen.</translation>
    </message>
    <message>
        <source>Click points along a line; double-click to finish.</source>
        <translation>Klicken Sie Punkte entlang einer Linie an; Doppelklick beendet sie.</translation>
    </message>
    <message>
        <source>Click the corners of an area; double-click to finish.</source>
        <translation>Klicken Sie die Ecken einer Fläche an; Doppelklick beendet sie.</translation>
    </message>
    <message>
        <source>Click the ends and bends of a profile; double-click to finish.</source>
        <translation>Klicken Sie Enden und Knicke eines Profils an; Doppelklick beendet es.</translation>
    </message>
    <message>
        <source>Click three or more points of one rock layer; double-click to finish.</source>
        <translation>Klicken Sie drei oder mehr Punkte einer Gesteinsschicht an; Doppelklick beendet die Messung.</translation>
    </message>
    <message>
        <source>Click three or more points on the rim; double-click to finish.</source>
        <translation>Klicken Sie drei oder mehr Punkte auf dem Rand an; Doppelklick beendet die Messung.</translation>
    </message>
    <message>
        <source>Click a place to measure its slope.</source>
        <translation>Klicken Sie eine Stelle an, um ihre Neigung zu messen.</translation>
    </message>
    <message>
        <source>Click to place one more point; Backspace removes the last one.</source>
        <translation>Klicken Sie, um noch einen Punkt zu setzen; die Rücktaste entfernt den letzten.</translation>
    </message>
    <message>
        <source>Click to place %1 more points; Backspace removes the last one.</source>
        <translation>Klicken Sie, um noch %1 Punkte zu setzen; die Rücktaste entfernt den letzten.</translation>
    </message>
    <message>
        <source>%1: from %2 to %3</source>
        <translation>%1: von %2 bis %3</translation>
    </message>
    <message>
        <source>Approximate; every sample is being read…</source>
        <translation>Näherung; alle Abtastwerte werden gelesen …</translation>
    </message>
    <message>
        <source>Approximate: measured on a preview.</source>
        <translation>Näherung: auf einer Vorschau gemessen.</translation>
    </message>
    <message>
        <source>Measuring…</source>
        <translation>Wird gemessen …</translation>
    </message>
    <message>
        <source>Save Profile</source>
        <translation>Profil speichern</translation>
    </message>
    <message>
        <source>Cannot Save Profile</source>
        <translation>Das Profil kann nicht gespeichert werden</translation>
    </message>
    <message>
        <source>CSV table (*.csv)</source>
        <translation>CSV-Tabelle (*.csv)</translation>
    </message>
    <message>
        <source>profile</source>
        <translation>profil</translation>
    </message>
    <message>
        <source>Cannot Save Measurements</source>
        <translation>Die Messungen können nicht gespeichert werden</translation>
    </message>
    <message>
        <source>Save Measurements</source>
        <translation>Messungen speichern</translation>
    </message>
    <message>
        <source>GeoPackage (*.gpkg)</source>
        <translation>GeoPackage (*.gpkg)</translation>
    </message>
    <message>
        <source>Crater count with positions (*.scc)</source>
        <translation>Kraterzählung mit Positionen (*.scc)</translation>
    </message>
    <message>
        <source>Crater diameters (*.diam)</source>
        <translation>Kraterdurchmesser (*.diam)</translation>
    </message>
    <message>
        <source>measurements</source>
        <translation>messungen</translation>
    </message>
    <message>
        <source>Save H&amp;ypsometry…</source>
        <translation>H&amp;ypsometrie speichern …</translation>
    </message>
    <message>
        <source>Save the area by classes of elevation as CSV, PNG, SVG or PDF</source>
        <translation>Die Fläche nach Höhenklassen als CSV, PNG, SVG oder PDF speichern</translation>
    </message>
    <message>
        <source>Save Hypsometry</source>
        <translation>Hypsometrie speichern</translation>
    </message>
    <message>
        <source>Cannot Save Hypsometry</source>
        <translation>Die Hypsometrie kann nicht gespeichert werden</translation>
    </message>
    <message>
        <source>hypsometry</source>
        <translation>hypsometrie</translation>
    </message>
    <message>
        <source>Without volumes: no plane fits so large or so empty a border.</source>
        <translation>Ohne Volumen: zu einem so großen oder so leeren Rand passt keine Ebene.</translation>
    </message>
    <message>
        <source>Click to add a point, double-click to finish. Backspace removes the last point.</source>
        <translation>Ein Klick fügt einen Punkt hinzu, ein Doppelklick schließt ab. Die Rücktaste entfernt den letzten Punkt.</translation>
    </message>
    <message>
        <source>Drag a point to move it; drag the line to insert one.</source>
        <translation>Ziehen Sie einen Punkt, um ihn zu verschieben, oder die Linie, um einen einzufügen.</translation>
    </message>
    <message>
        <source>Drag a point to move it.</source>
        <translation>Ziehen Sie einen Punkt, um ihn zu verschieben.</translation>
    </message>
    <message>
        <source>Drag a point to move it; drag the line to insert one. Select several profiles in the list to draw them over each other.</source>
        <translation>Ziehen Sie einen Punkt, um ihn zu verschieben, oder die Linie, um einen einzufügen. Wählen Sie mehrere Profile in der Liste, um sie übereinander zu zeichnen.</translation>
    </message>
</context>
<context>
    <name>marsview::Minimap</name>
    <message>
        <source>Overview map</source>
        <translation>Übersichtskarte</translation>
    </message>
    <message>
        <source>Click or drag to look at another place</source>
        <translation>Klicken oder ziehen Sie, um einen anderen Ort zu sehen</translation>
    </message>
    <message>
        <source>No map</source>
        <translation>Keine Karte</translation>
    </message>
    <message>
        <source>The whole map</source>
        <translation>Die ganze Karte</translation>
    </message>
    <message>
        <source>The view is at %1% of the way from west to east and %2% from south to north; %3% of the map is in sight. Arrow keys move it.</source>
        <extracomment>For screen readers: %1 and %2 are percentages of the map&apos;s width and height, %3 of its area</extracomment>
        <translation>Die Ansicht liegt bei %1 % des Wegs von West nach Ost und %2 % von Süd nach Nord; %3 % der Karte sind zu sehen. Die Pfeiltasten bewegen sie.</translation>
    </message>
    <message>
        <source>%1. The view is at %2; %3% of the map is in sight. Arrow keys move it.</source>
        <extracomment>For screen readers: %1 is what the map shows, &quot;North pole&quot;, %2 a position, %3 a percentage of the map&apos;s area</extracomment>
        <translation>%1. Die Ansicht liegt bei %2; %3 % der Karte sind zu sehen. Die Pfeiltasten bewegen sie.</translation>
    </message>
</context>
<context>
    <name>marsview::NameCompleter</name>
    <message>
        <source>Matching names</source>
        <translation>Passende Namen</translation>
    </message>
    <message>
        <source>%1 — %2</source>
        <extracomment>A place in a list: its name, then its kind and size</extracomment>
        <translation>%1 — %2</translation>
    </message>
</context>
<context>
    <name>marsview::NameField</name>
    <message>
        <source>Name of the new annotation</source>
        <translation>Name der neuen Anmerkung</translation>
    </message>
    <message>
        <source>Enter keeps the name, Esc the usual one</source>
        <translation>Die Eingabetaste übernimmt den Namen, Esc lässt den üblichen</translation>
    </message>
</context>
<context>
    <name>marsview::NameSearch</name>
    <message>
        <source>View › Go to Place… goes to coordinates (Ctrl+G).</source>
        <translation>Zu Koordinaten führt Ansicht › Gehe zu Ort … (Strg+G).</translation>
    </message>
    <message>
        <source>%1 names in %2</source>
        <extracomment>In the status bar: %1 is a number, %2 a file</extracomment>
        <translation>%1 Namen in %2</translation>
    </message>
    <message>
        <source>Open Names</source>
        <translation>Namen öffnen</translation>
    </message>
    <message>
        <source>Points with names (*.csv *.gpkg *.geojson *.json *.kml *.shp)</source>
        <translation>Punkte mit Namen (*.csv *.gpkg *.geojson *.json *.kml *.shp)</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
</context>
<context>
    <name>marsview::NoticeBar</name>
    <message>
        <source>Notices</source>
        <translation>Meldungen</translation>
    </message>
    <message>
        <source>Action</source>
        <translation>Aktion</translation>
    </message>
    <message>
        <source>Details</source>
        <translation>Einzelheiten</translation>
    </message>
    <message>
        <source>Show where the notice comes from</source>
        <translation>Zeigen, woher die Meldung kommt</translation>
    </message>
    <message>
        <source>Show the next notice</source>
        <translation>Die nächste Meldung zeigen</translation>
    </message>
    <message>
        <source>Close Notice</source>
        <translation>Meldung schließen</translation>
    </message>
    <message>
        <source>Close this notice</source>
        <translation>Diese Meldung schließen</translation>
    </message>
    <message>
        <source>%1 of %2 ›</source>
        <extracomment>On a button that shows the next notice: %1 is its number, %2 how many notices there are</extracomment>
        <translation>%1 von %2 ›</translation>
    </message>
    <message>
        <source>Next Notice</source>
        <translation>Nächste Meldung</translation>
    </message>
</context>
<context>
    <name>marsview::OverrideForm</name>
    <message>
        <source>“%1” is not a number. Enter one such as −1737.4 or 1e-3.</source>
        <extracomment>Below a field: %1 is the text entered</extracomment>
        <translation>„%1“ ist keine Zahl. Geben Sie eine ein wie −1737,4 oder 1e-3.</translation>
    </message>
    <message>
        <source>Leave blank to keep the file&apos;s value. The file itself is never changed.</source>
        <translation>Leer lassen, um den Wert der Datei zu behalten. Die Datei selbst wird nie geändert.</translation>
    </message>
    <message>
        <source>&amp;CRS</source>
        <translation>&amp;KBS</translation>
    </message>
    <message>
        <source>&amp;Body</source>
        <translation>&amp;Himmelskörper</translation>
    </message>
    <message>
        <source>&amp;Equatorial radius (m)</source>
        <translation>&amp;Äquatorradius (m)</translation>
    </message>
    <message>
        <source>&amp;Polar radius (m)</source>
        <translation>&amp;Polradius (m)</translation>
    </message>
    <message>
        <source>Elevation &amp;unit</source>
        <translation>Höhen&amp;einheit</translation>
    </message>
    <message>
        <source>&amp;Scale</source>
        <translation>&amp;Skalierung</translation>
    </message>
    <message>
        <source>Elevation = sample × scale + offset, in the elevation unit</source>
        <translation>Höhe = Abtastwert × Skalierung + Versatz, in der Höheneinheit</translation>
    </message>
    <message>
        <source>&amp;Offset</source>
        <translation>&amp;Versatz</translation>
    </message>
    <message>
        <source>Vertical &amp;datum</source>
        <translation>Höhen&amp;bezug</translation>
    </message>
    <message>
        <source>&amp;Nodata value</source>
        <translation>&amp;Nodata-Wert</translation>
    </message>
    <message>
        <source>x of the corner</source>
        <translation>x der Ecke</translation>
    </message>
    <message>
        <source>x per column</source>
        <translation>x je Spalte</translation>
    </message>
    <message>
        <source>x per row</source>
        <translation>x je Zeile</translation>
    </message>
    <message>
        <source>y of the corner</source>
        <translation>y der Ecke</translation>
    </message>
    <message>
        <source>y per column</source>
        <translation>y je Spalte</translation>
    </message>
    <message>
        <source>y per row</source>
        <translation>y je Zeile</translation>
    </message>
    <message>
        <source>Geotransform, from the outer corner of the first pixel:</source>
        <translation>Geotransformation, von der äußeren Ecke des ersten Pixels aus:</translation>
    </message>
    <message>
        <source>&amp;Apply</source>
        <translation>&amp;Anwenden</translation>
    </message>
    <message>
        <source>Cance&amp;l</source>
        <translation>Ab&amp;brechen</translation>
    </message>
    <message>
        <source>&amp;Reset to File</source>
        <translation>&amp;Zurück zur Datei</translation>
    </message>
    <message>
        <source>Use the values of the file alone</source>
        <translation>Nur die Werte der Datei benutzen</translation>
    </message>
    <message>
        <source>Type a name or a code to search, such as UTM 10N, Mars equirectangular or EPSG:32610. A PROJ string or WKT also works.</source>
        <translation>Geben Sie einen Namen oder Code ein, etwa UTM 10N, Mars equirectangular oder EPSG:32610. Eine PROJ-Zeichenkette oder WKT geht auch.</translation>
    </message>
    <message>
        <source>As in the file</source>
        <extracomment>The first entry of a list: the file&apos;s own value, and which it is</extracomment>
        <translation>Wie in der Datei</translation>
    </message>
    <message>
        <source>As in the file: %1</source>
        <translation>Wie in der Datei: %1</translation>
    </message>
    <message>
        <source>%1, on %2</source>
        <extracomment>%1 is the name of a coordinate reference system, %2 the body it is on</extracomment>
        <translation>%1 (%2)</translation>
    </message>
</context>
<context>
    <name>marsview::PictureDrawing</name>
    <message>
        <source>There is not enough memory for a picture of this size; choose a smaller one</source>
        <translation>Für ein Bild dieser Größe reicht der Speicher nicht; wählen Sie ein kleineres</translation>
    </message>
</context>
<context>
    <name>marsview::PictureSaver</name>
    <message>
        <source>Save Picture</source>
        <translation>Bild speichern</translation>
    </message>
    <message>
        <source>PNG picture (*.png)</source>
        <translation>PNG-Bild (*.png)</translation>
    </message>
    <message>
        <source>JPEG picture (*.jpg *.jpeg)</source>
        <translation>JPEG-Bild (*.jpg *.jpeg)</translation>
    </message>
    <message>
        <source>TIFF picture (*.tif *.tiff)</source>
        <translation>TIFF-Bild (*.tif *.tiff)</translation>
    </message>
</context>
<context>
    <name>marsview::PictureTaker</name>
    <message>
        <source>%1: the picture cannot be written (%2); choose a writable folder and a name that ends in .png or .jpg</source>
        <translation>%1: Das Bild kann nicht geschrieben werden (%2); wählen Sie einen beschreibbaren Ordner und einen Namen, der auf .png oder .jpg endet</translation>
    </message>
</context>
<context>
    <name>marsview::PlaceCommands</name>
    <message>
        <source>Vector file</source>
        <translation>Vektordatei</translation>
    </message>
    <message>
        <source>Add Point</source>
        <translation>Punkt hinzufügen</translation>
    </message>
    <message>
        <source>&amp;Add</source>
        <translation>&amp;Hinzufügen</translation>
    </message>
</context>
<context>
    <name>marsview::PlaceDialog</name>
    <message>
        <source>What Is Here</source>
        <translation>Was ist hier</translation>
    </message>
    <message>
        <source>&amp;Copy All</source>
        <translation>Alles &amp;kopieren</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <extracomment>A line of text that is copied: %1 is a name, %2 its value</extracomment>
        <translation>%1: %2</translation>
    </message>
</context>
<context>
    <name>marsview::PlaceMark</name>
    <message>
        <source>Marked place</source>
        <translation>Markierter Ort</translation>
    </message>
</context>
<context>
    <name>marsview::PreferencesDialog</name>
    <message>
        <source>&amp;Anti-aliasing</source>
        <translation>&amp;Kantenglättung</translation>
    </message>
    <message>
        <source>Preferences</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Restore &amp;Defaults</source>
        <translation>Stan&amp;dardwerte wiederherstellen</translation>
    </message>
    <message>
        <source>Follow system</source>
        <comment>language</comment>
        <extracomment>A language: that of the desktop</extracomment>
        <translation>Wie das System</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>Takes effect when MarsView is started again</source>
        <translation>Gilt, sobald MarsView neu gestartet wird</translation>
    </message>
    <message>
        <source>Follow system</source>
        <extracomment>A theme: as light or dark as the desktop</extracomment>
        <translation>Wie das System</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Theme</source>
        <translation>Farbschema</translation>
    </message>
    <message>
        <source>Meters</source>
        <translation>Meter</translation>
    </message>
    <message>
        <source>Feet</source>
        <translation>Fuß</translation>
    </message>
    <message>
        <source>Elevation unit</source>
        <translation>Höheneinheit</translation>
    </message>
    <message numerus="yes">
        <source>%n fps</source>
        <extracomment>Frames per second</extracomment>
        <translation>
            <numerusform>%n Bild/s</numerusform>
            <numerusform>%n Bilder/s</numerusform>
        </translation>
    </message>
    <message>
        <source>Frame rate while moving</source>
        <translation>Bildrate bei Bewegung</translation>
    </message>
    <message>
        <source>A higher rate makes motion smoother and the terrain coarser while it moves</source>
        <translation>Eine höhere Rate macht die Bewegung flüssiger und das Gelände gröber, solange es sich bewegt</translation>
    </message>
    <message>
        <source>Anti-aliasing</source>
        <translation>Kantenglättung</translation>
    </message>
    <message>
        <source>Smooth edges when the picture is at rest</source>
        <translation>Glatte Kanten, wenn das Bild ruht</translation>
    </message>
    <message>
        <source>Appearance</source>
        <extracomment>A group of the preferences</extracomment>
        <translation>Aussehen</translation>
    </message>
    <message>
        <source>&amp;Language</source>
        <translation>S&amp;prache</translation>
    </message>
    <message>
        <source>&amp;Theme</source>
        <translation>Farb&amp;schema</translation>
    </message>
    <message>
        <source>&amp;Elevation unit</source>
        <translation>&amp;Höheneinheit</translation>
    </message>
    <message>
        <source>Map view</source>
        <extracomment>A group of the preferences: the picture of the terrain</extracomment>
        <translation>Kartenansicht</translation>
    </message>
    <message>
        <source>Haptics</source>
        <extracomment>A group of the preferences</extracomment>
        <translation>Haptik</translation>
    </message>
    <message>
        <source>Connect the last &amp;device at the start</source>
        <translation>Das letzte Gerät beim Start &amp;verbinden</translation>
    </message>
    <message>
        <source>The device that was connected when MarsView was closed. The simulated hand is never connected by itself</source>
        <translation>Das Gerät, das beim Schließen von MarsView verbunden war. Die simulierte Hand wird nie von selbst verbunden</translation>
    </message>
    <message>
        <source>&amp;Frame rate while moving</source>
        <translation>&amp;Bildrate bei Bewegung</translation>
    </message>
    <message>
        <source>Memory</source>
        <extracomment>A group of the preferences</extracomment>
        <translation>Speicher</translation>
    </message>
    <message>
        <source>Tiles of &amp;large maps</source>
        <translation>Kacheln &amp;großer Karten</translation>
    </message>
    <message>
        <source>Pages of the preferences</source>
        <translation>Seiten der Einstellungen</translation>
    </message>
    <message>
        <source>&amp;General</source>
        <extracomment>A page of the preferences</extracomment>
        <translation>&amp;Allgemein</translation>
    </message>
    <message>
        <source>&amp;Coordinates</source>
        <extracomment>A page of the preferences</extracomment>
        <translation>&amp;Koordinaten</translation>
    </message>
    <message>
        <source>&amp;Storage</source>
        <extracomment>A page of the preferences: files that are kept on disk</extracomment>
        <translation>Spei&amp;cherplatz</translation>
    </message>
</context>
<context>
    <name>marsview::ProfilePlot</name>
    <message>
        <source>Profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>The left and right arrow keys move the cursor along the profile</source>
        <translation>Die Pfeiltasten links und rechts bewegen den Cursor entlang des Profils</translation>
    </message>
    <message>
        <source>Distance (km)</source>
        <translation>Entfernung (km)</translation>
    </message>
    <message>
        <source>Distance (m)</source>
        <translation>Entfernung (m)</translation>
    </message>
    <message>
        <source>Elevation (%1), approximate</source>
        <translation>Höhe (%1), Näherung</translation>
    </message>
    <message>
        <source>Elevation (%1)</source>
        <translation>Höhe (%1)</translation>
    </message>
    <message>
        <source>Slope (°)</source>
        <translation>Neigung (°)</translation>
    </message>
    <message>
        <source>no data</source>
        <translation>keine Daten</translation>
    </message>
    <message>
        <source>%1 at %2</source>
        <translation>%1 bei %2</translation>
    </message>
</context>
<context>
    <name>marsview::ProjectController</name>
    <message>
        <source>The project is saved, but not the GeoPackage of its measurements: %1</source>
        <translation>Das Projekt ist gespeichert, aber nicht das GeoPackage seiner Messungen: %1</translation>
    </message>
    <message>
        <source>The project is saved, but not the GeoPackage of its annotations: %1</source>
        <translation>Das Projekt ist gespeichert, aber nicht das GeoPackage mit seinen Anmerkungen: %1</translation>
    </message>
    <message>
        <source>Reading the project</source>
        <extracomment>In the status bar, of a project that was never saved</extracomment>
        <translation>Das Projekt wird gelesen</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <translation>%1 wird gelesen</translation>
    </message>
    <message>
        <source>Writing %1</source>
        <extracomment>In the status bar: %1 is a file</extracomment>
        <translation>%1 wird geschrieben</translation>
    </message>
</context>
<context>
    <name>marsview::ProjectMenu</name>
    <message>
        <source>&amp;New Project</source>
        <translation>&amp;Neues Projekt</translation>
    </message>
    <message>
        <source>Close all layers and start an empty project</source>
        <translation>Alle Layer schließen und ein leeres Projekt beginnen</translation>
    </message>
    <message>
        <source>Open Pro&amp;ject…</source>
        <translation>Pro&amp;jekt öffnen …</translation>
    </message>
    <message>
        <source>Open the layers, colors and view that were saved in a project</source>
        <translation>Layer, Farben und Ansicht öffnen, die in einem Projekt gespeichert wurden</translation>
    </message>
    <message>
        <source>Rec&amp;ent Projects</source>
        <translation>&amp;Zuletzt benutzte Projekte</translation>
    </message>
    <message>
        <source>&amp;Save Project</source>
        <translation>Projekt &amp;speichern</translation>
    </message>
    <message>
        <source>Save the layers, colors and view</source>
        <translation>Layer, Farben und Ansicht speichern</translation>
    </message>
    <message>
        <source>Sa&amp;ve Project As…</source>
        <translation>Projekt speichern &amp;unter …</translation>
    </message>
    <message>
        <source>Unsaved Changes</source>
        <translation>Ungespeicherte Änderungen</translation>
    </message>
    <message>
        <source>Save the layers and settings as a project?</source>
        <translation>Layer und Einstellungen als Projekt speichern?</translation>
    </message>
    <message>
        <source>Save the changes to %1?</source>
        <translation>Die Änderungen an %1 speichern?</translation>
    </message>
    <message>
        <source>&amp;Don&apos;t Save</source>
        <translation>&amp;Nicht speichern</translation>
    </message>
    <message>
        <source>Save Project As</source>
        <translation>Projekt speichern unter</translation>
    </message>
    <message>
        <source>MarsView projects (*.mvproj)</source>
        <translation>MarsView-Projekte (*.mvproj)</translation>
    </message>
    <message>
        <source>project</source>
        <translation>projekt</translation>
    </message>
    <message>
        <source>Open Project</source>
        <translation>Projekt öffnen</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Restore Project</source>
        <translation>Projekt wiederherstellen</translation>
    </message>
    <message>
        <source>MarsView ended unexpectedly. Restore the unsaved layers and settings (%1)?</source>
        <translation>MarsView endete unerwartet. Die ungespeicherten Layer und Einstellungen wiederherstellen (%1)?</translation>
    </message>
    <message>
        <source>MarsView ended unexpectedly. Restore the unsaved changes to %1 (%2)?</source>
        <translation>MarsView endete unerwartet. Die ungespeicherten Änderungen an %1 wiederherstellen (%2)?</translation>
    </message>
    <message>
        <source>&amp;Restore</source>
        <translation>&amp;Wiederherstellen</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Löschen</translation>
    </message>
    <message>
        <source>Ask &amp;Later</source>
        <translation>S&amp;päter fragen</translation>
    </message>
    <message>
        <source>Locate %1</source>
        <extracomment>Title of a file dialog; %1 is a layer</extracomment>
        <translation>%1 suchen</translation>
    </message>
    <message>
        <source>The layer “%1” is missing. %2</source>
        <extracomment>%1 is a layer, %2 says which file cannot be opened, and why</extracomment>
        <translation>Der Layer „%1“ fehlt. %2</translation>
    </message>
    <message>
        <source>&amp;Locate…</source>
        <translation>&amp;Suchen …</translation>
    </message>
    <message>
        <source>&amp;Remove Layer</source>
        <translation>Layer &amp;entfernen</translation>
    </message>
    <message>
        <source>Missing Layer</source>
        <extracomment>On a button with a menu: what to do about a missing layer</extracomment>
        <translation>Fehlender Layer</translation>
    </message>
</context>
<context>
    <name>marsview::RecentFiles</name>
    <message>
        <source>%1 (missing)</source>
        <extracomment>In the list of recent files: %1 is a file that no longer exists</extracomment>
        <translation>%1 (fehlt)</translation>
    </message>
    <message>
        <source>&amp;Clear Menu</source>
        <translation>Menü &amp;leeren</translation>
    </message>
</context>
<context>
    <name>marsview::ReportExporter</name>
    <message>
        <source>E&amp;xport Report…</source>
        <translation>Be&amp;richt exportieren …</translation>
    </message>
    <message>
        <source>Save the map with legend and scale, the measurements and their diagrams as one PDF or web page</source>
        <translation>Die Karte mit Legende und Maßstab, die Messungen und ihre Diagramme als ein PDF oder eine Webseite speichern</translation>
    </message>
    <message>
        <source>Export Report</source>
        <translation>Bericht exportieren</translation>
    </message>
    <message>
        <source>Map</source>
        <translation>Karte</translation>
    </message>
    <message>
        <source>Source of the data, author</source>
        <translation>Quelle der Daten, Autor</translation>
    </message>
    <message>
        <source>&amp;Measurements</source>
        <translation>&amp;Messungen</translation>
    </message>
    <message>
        <source>&amp;Diagrams</source>
        <translation>&amp;Diagramme</translation>
    </message>
    <message>
        <source>There are no measurements yet</source>
        <translation>Es gibt noch keine Messungen</translation>
    </message>
    <message>
        <source>&amp;Title</source>
        <translation>&amp;Titel</translation>
    </message>
    <message>
        <source>&amp;Credit</source>
        <translation>&amp;Quellenangabe</translation>
    </message>
    <message>
        <source>Include</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <extracomment>On a button: choose a file for the report</extracomment>
        <translation>&amp;Exportieren …</translation>
    </message>
    <message>
        <source>PDF document (*.pdf)</source>
        <translation>PDF-Dokument (*.pdf)</translation>
    </message>
    <message>
        <source>Web page (*.html)</source>
        <translation>Webseite (*.html)</translation>
    </message>
    <message>
        <source>report</source>
        <extracomment>The name of a report&apos;s file, without its extension</extracomment>
        <translation>bericht</translation>
    </message>
    <message>
        <source>%1: cannot write the report (%2); choose another folder</source>
        <extracomment>%1 is a file, %2 the reason</extracomment>
        <translation>%1: Der Bericht kann nicht geschrieben werden (%2); wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
        <source>&amp;Annotations</source>
        <translation>&amp;Anmerkungen</translation>
    </message>
    <message>
        <source>There are no annotations yet</source>
        <translation>Es gibt noch keine Anmerkungen</translation>
    </message>
    <message>
        <source>The map is not ready yet; try again in a moment</source>
        <translation>Die Karte ist noch nicht bereit. Versuchen Sie es gleich noch einmal</translation>
    </message>
</context>
<context>
    <name>marsview::SavePictureDialog</name>
    <message>
        <source>&amp;Legend</source>
        <extracomment>In a picture that is saved</extracomment>
        <translation>&amp;Legende</translation>
    </message>
    <message>
        <source>&amp;Compass and scale bar</source>
        <extracomment>In a picture that is saved</extracomment>
        <translation>&amp;Kompass und Maßstabsbalken</translation>
    </message>
    <message>
        <source>L&amp;abels and lines on the map</source>
        <extracomment>In a picture that is saved: names of places, graticule, measurements</extracomment>
        <translation>&amp;Beschriftung und Linien auf der Karte</translation>
    </message>
    <message>
        <source>Save Picture</source>
        <translation>Bild speichern</translation>
    </message>
    <message>
        <source>Custom</source>
        <extracomment>Size of a picture: it is typed</extracomment>
        <translation>Eigene</translation>
    </message>
    <message>
        <source>Picture size</source>
        <translation>Bildgröße</translation>
    </message>
    <message>
        <source> px</source>
        <extracomment>Pixels, after a number</extracomment>
        <translation> px</translation>
    </message>
    <message>
        <source>Width in pixels</source>
        <translation>Breite in Pixeln</translation>
    </message>
    <message>
        <source>Height in pixels</source>
        <translation>Höhe in Pixeln</translation>
    </message>
    <message>
        <source>&amp;Size</source>
        <translation>&amp;Größe</translation>
    </message>
    <message>
        <source>&amp;Width</source>
        <translation>&amp;Breite</translation>
    </message>
    <message>
        <source>&amp;Height</source>
        <translation>&amp;Höhe</translation>
    </message>
    <message>
        <source>Include</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>Sa&amp;ve As…</source>
        <extracomment>On a button: choose a file for the picture</extracomment>
        <translation>Speichern &amp;unter …</translation>
    </message>
    <message>
        <source>The graphics driver draws at most %1 pixels per side.</source>
        <translation>Der Grafiktreiber zeichnet höchstens %1 Pixel je Seite.</translation>
    </message>
    <message>
        <source>Choose at most %1 million pixels.</source>
        <translation>Wählen Sie höchstens %1 Millionen Pixel.</translation>
    </message>
    <message>
        <source>%1 × %2</source>
        <extracomment>Size of a picture: width and height in pixels</extracomment>
        <translation>%1 × %2</translation>
    </message>
    <message>
        <source>As in the window (%1)</source>
        <extracomment>Size of a picture; %1 are its pixels, such as 1,280 × 800</extracomment>
        <translation>Wie im Fenster (%1)</translation>
    </message>
    <message>
        <source>%2 times the window (%1)</source>
        <translation>%2-mal das Fenster (%1)</translation>
    </message>
</context>
<context>
    <name>marsview::SavedViews</name>
    <message>
        <source>&amp;Save View</source>
        <translation>Ansicht &amp;speichern</translation>
    </message>
    <message>
        <source>Save the current camera and exaggeration in the project</source>
        <translation>Die gegenwärtige Kamera und Überhöhung im Projekt behalten</translation>
    </message>
    <message>
        <source>&amp;Go to View</source>
        <translation>&amp;Gehe zur Ansicht</translation>
    </message>
    <message>
        <source>Fly to the selected view</source>
        <translation>Zur ausgewählten Ansicht fliegen</translation>
    </message>
    <message>
        <source>Upda&amp;te View</source>
        <translation>Ansicht &amp;aktualisieren</translation>
    </message>
    <message>
        <source>Update the selected view to the current camera and exaggeration</source>
        <translation>Der ausgewählten Ansicht die gegenwärtige Kamera und Überhöhung geben</translation>
    </message>
    <message>
        <source>Re&amp;name View</source>
        <translation>Ansicht &amp;umbenennen</translation>
    </message>
    <message>
        <source>Rename the selected view</source>
        <translation>Die ausgewählte Ansicht umbenennen</translation>
    </message>
    <message>
        <source>Move View &amp;Up</source>
        <translation>Ansicht nach &amp;oben</translation>
    </message>
    <message>
        <source>Move the view up (Alt+Up)</source>
        <translation>Die Ansicht nach oben verschieben (Alt+Auf)</translation>
    </message>
    <message>
        <source>Move View &amp;Down</source>
        <translation>Ansicht nach u&amp;nten</translation>
    </message>
    <message>
        <source>Move the view down (Alt+Down)</source>
        <translation>Die Ansicht nach unten verschieben (Alt+Ab)</translation>
    </message>
    <message>
        <source>R&amp;emove View</source>
        <translation>Ansicht &amp;entfernen</translation>
    </message>
    <message>
        <source>Remove the selected view (Delete)</source>
        <translation>Die ausgewählte Ansicht entfernen (Entf)</translation>
    </message>
    <message>
        <source>&amp;Fly-Through…</source>
        <translation>Über&amp;flug …</translation>
    </message>
    <message>
        <source>Fly along the saved views or a line, and record it</source>
        <translation>Entlang der gespeicherten Ansichten oder einer Linie fliegen und es aufzeichnen</translation>
    </message>
    <message>
        <source>Show &amp;Panel</source>
        <translation>&amp;Bedienfeld zeigen</translation>
    </message>
    <message>
        <source>Show the saved views</source>
        <translation>Die gespeicherten Ansichten zeigen</translation>
    </message>
    <message>
        <source>Saved &amp;Views</source>
        <translation>Gespeicherte Ans&amp;ichten</translation>
    </message>
    <message>
        <source>Go to View %1</source>
        <translation>Gehe zur Ansicht %1</translation>
    </message>
    <message>
        <source>The view looks beyond the map&apos;s projection and cannot be saved</source>
        <translation>Die Ansicht blickt über die Projektion der Karte hinaus und kann nicht gespeichert werden</translation>
    </message>
    <message>
        <source>Updated %1</source>
        <extracomment>In the status bar, for a few seconds; %1 is a saved view</extracomment>
        <translation>%1 aktualisiert</translation>
    </message>
    <message>
        <source>The layer of %1 is not open</source>
        <translation>Der Layer von %1 ist nicht geöffnet</translation>
    </message>
    <message>
        <source>%1 is on %2: open a map of it first</source>
        <translation>%1 liegt auf %2: Öffnen Sie zuerst eine Karte davon</translation>
    </message>
    <message>
        <source>%1 is outside the map&apos;s projection</source>
        <extracomment>%1 is a saved view</extracomment>
        <translation>%1 liegt außerhalb der Projektion der Karte</translation>
    </message>
    <message>
        <source>%1
Exaggeration ×%2</source>
        <extracomment>Of a saved view; %1 is a position or a body, %2 a factor</extracomment>
        <translation>%1
Überhöhung ×%2</translation>
    </message>
</context>
<context>
    <name>marsview::SavedViewsPanel</name>
    <message>
        <source>Saved views</source>
        <translation>Gespeicherte Ansichten</translation>
    </message>
    <message>
        <source>No saved views.
Move the map to a view worth keeping and press %1. A double click on a saved view flies back to it.</source>
        <extracomment>%1 is a key</extracomment>
        <translation>Keine gespeicherten Ansichten.
Bewegen Sie die Karte zu einer Ansicht, die Sie behalten wollen, und drücken Sie %1. Ein Doppelklick auf eine gespeicherte Ansicht fliegt dorthin zurück.</translation>
    </message>
</context>
<context>
    <name>marsview::ScaleBarView</name>
    <message>
        <source>Scale</source>
        <translation>Maßstab</translation>
    </message>
    <message>
        <source>Length of the bar on the ground, in the middle of the picture</source>
        <translation>Länge des Balkens auf dem Boden, in der Bildmitte</translation>
    </message>
    <message>
        <source>Scale %1</source>
        <extracomment>%1 is the length of the scale bar, for example &quot;500 km&quot;</extracomment>
        <translation>Maßstab %1</translation>
    </message>
</context>
<context>
    <name>marsview::SceneCommands</name>
    <message>
        <source>Cannot Show Globe</source>
        <translation>Der Globus kann nicht gezeigt werden</translation>
    </message>
    <message>
        <source>Open a map first</source>
        <translation>Öffnen Sie zuerst eine Karte</translation>
    </message>
    <message>
        <source>Not available: the body of the topmost layer is not known. Set it with Layer › Set Body, CRS…</source>
        <translation>Nicht verfügbar: Der Himmelskörper des obersten Layers ist unbekannt. Legen Sie ihn mit Layer › Raumbezug festlegen … fest</translation>
    </message>
    <message>
        <source>Show all layers of one body where they lie on it</source>
        <translation>Alle Layer eines Himmelskörpers dort zeigen, wo sie auf ihm liegen</translation>
    </message>
    <message>
        <source>Show the flat map again (G)</source>
        <translation>Wieder die ebene Karte zeigen (G)</translation>
    </message>
    <message>
        <source>Show all layers of one body on it, as a globe (G)</source>
        <translation>Alle Layer eines Himmelskörpers auf ihm zeigen, als Globus (G)</translation>
    </message>
</context>
<context>
    <name>marsview::SessionController</name>
    <message>
        <source>Remove %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>%1 entfernen</translation>
    </message>
    <message>
        <source>Locate %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>%1 suchen</translation>
    </message>
    <message>
        <source>Open %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>%1 öffnen</translation>
    </message>
    <message>
        <source>Keep %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>%1 behalten</translation>
    </message>
    <message>
        <source>%1: loading was canceled</source>
        <extracomment>%1 is a file</extracomment>
        <translation>%1: Das Laden wurde abgebrochen</translation>
    </message>
    <message>
        <source>Georeferencing of %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>Georeferenzierung von %1</translation>
    </message>
    <message>
        <source>Move %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>%1 verschieben</translation>
    </message>
    <message>
        <source>Show %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>%1 zeigen</translation>
    </message>
    <message>
        <source>Hide %1</source>
        <translation>%1 verbergen</translation>
    </message>
    <message>
        <source>Color Ramp of %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>Farbskala von %1</translation>
    </message>
    <message>
        <source>Rename %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>%1 umbenennen</translation>
    </message>
    <message>
        <source>Shading</source>
        <extracomment>Continues &quot;Undo …&quot;</extracomment>
        <translation>Schattierung</translation>
    </message>
    <message>
        <source>Order of Layers</source>
        <extracomment>Continues &quot;Undo …&quot;</extracomment>
        <translation>Reihenfolge der Layer</translation>
    </message>
    <message>
        <source>Contours</source>
        <extracomment>Continues &quot;Undo …&quot;</extracomment>
        <translation>Höhenlinien</translation>
    </message>
    <message>
        <source>Change %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a file</extracomment>
        <translation>%1 ändern</translation>
    </message>
    <message>
        <source>Close %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a file</extracomment>
        <translation>%1 schließen</translation>
    </message>
    <message>
        <source>Contour Interval</source>
        <extracomment>Continues &quot;Undo …&quot;</extracomment>
        <translation>Äquidistanz</translation>
    </message>
    <message>
        <source>Light</source>
        <extracomment>Continues &quot;Undo …&quot;</extracomment>
        <translation>Licht</translation>
    </message>
    <message>
        <source>Light Fixed in the View</source>
        <extracomment>Continues &quot;Undo …&quot;</extracomment>
        <translation>Licht fest in der Ansicht</translation>
    </message>
    <message>
        <source>Subsolar Point</source>
        <extracomment>Continues &quot;Undo …&quot;</extracomment>
        <translation>Subsolarer Punkt</translation>
    </message>
    <message>
        <source>Light Fixed on the Body</source>
        <extracomment>Continues &quot;Undo …&quot;</extracomment>
        <translation>Licht fest am Himmelskörper</translation>
    </message>
    <message>
        <source>Color Stretch of %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>Farbspreizung von %1</translation>
    </message>
    <message>
        <source>Slope Colors of %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>Neigungsfarben von %1</translation>
    </message>
    <message>
        <source>Blended Edges of %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>Überblendete Kanten von %1</translation>
    </message>
    <message>
        <source>Stretch of %1 to Current View</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a layer</extracomment>
        <translation>Spreizung von %1 auf die aktuelle Ansicht</translation>
    </message>
    <message>
        <source>Exaggeration ×%1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a factor</extracomment>
        <translation>Überhöhung ×%1</translation>
    </message>
    <message>
        <source>%1: its overviews are gone. Build them again, or choose another folder for prepared maps in the preferences</source>
        <extracomment>%1 is a file</extracomment>
        <translation>%1: Die Übersichten sind verschwunden. Erstellen Sie sie neu, oder wählen Sie in den Einstellungen einen anderen Ordner für vorbereitete Karten</translation>
    </message>
    <message>
        <source>Save View %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a saved view</extracomment>
        <translation>Ansicht %1 speichern</translation>
    </message>
    <message>
        <source>Update View %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a saved view</extracomment>
        <translation>Ansicht %1 aktualisieren</translation>
    </message>
    <message>
        <source>Rename View %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a saved view</extracomment>
        <translation>Ansicht %1 umbenennen</translation>
    </message>
    <message>
        <source>Move View %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a saved view</extracomment>
        <translation>Ansicht %1 verschieben</translation>
    </message>
    <message>
        <source>Remove View %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a saved view</extracomment>
        <translation>Ansicht %1 entfernen</translation>
    </message>
    <message>
        <source>Go to View %1</source>
        <extracomment>Continues &quot;Undo …&quot;; %1 is a saved view</extracomment>
        <translation>Gehe zur Ansicht %1</translation>
    </message>
</context>
<context>
    <name>marsview::SoundCommand</name>
    <message>
        <source>Cannot Play Sound</source>
        <translation>Ton kann nicht gespielt werden</translation>
    </message>
</context>
<context>
    <name>marsview::StatusReadout</name>
    <message>
        <source>outside the map</source>
        <extracomment>In place of a coordinate: nothing of the map is pointed at</extracomment>
        <translation>außerhalb der Karte</translation>
    </message>
    <message>
        <source>Stylus</source>
        <extracomment>Before a coordinate: the place under the stylus of a haptic device</extracomment>
        <translation>Stift</translation>
    </message>
    <message>
        <source>Center</source>
        <extracomment>Before a coordinate: the place in the middle of the picture</extracomment>
        <translation>Mitte</translation>
    </message>
    <message>
        <source>Pointer</source>
        <extracomment>Before a coordinate: the place under the mouse pointer</extracomment>
        <translation>Zeiger</translation>
    </message>
    <message>
        <source>full detail</source>
        <translation>volles Detail</translation>
    </message>
    <message>
        <source>detail %1 px</source>
        <translation>Detail %1 px</translation>
    </message>
    <message>
        <source>Source of the position</source>
        <translation>Worunter die Position liegt</translation>
    </message>
    <message>
        <source>Position under the pointer, the stylus or the crosshair</source>
        <translation>Position unter dem Zeiger, dem Stift oder dem Fadenkreuz</translation>
    </message>
    <message>
        <source>Ctrl+C copies it</source>
        <translation>Strg+C kopiert sie</translation>
    </message>
    <message>
        <source>Elevation under the pointer, the stylus or the crosshair</source>
        <translation>Höhe unter dem Zeiger, dem Stift oder dem Fadenkreuz</translation>
    </message>
    <message>
        <source>Largest error of the picture</source>
        <translation>Größter Fehler des Bilds</translation>
    </message>
    <message>
        <source>Coordinate format</source>
        <translation>Koordinatenformat</translation>
    </message>
    <message>
        <source>loading…</source>
        <extracomment>Shown instead of the error of the picture: pieces are on their way</extracomment>
        <translation>lädt …</translation>
    </message>
    <message>
        <source>incomplete</source>
        <translation>unvollständig</translation>
    </message>
    <message>
        <source>preview</source>
        <translation>Vorschau</translation>
    </message>
    <message>
        <source>≈ %1</source>
        <translation>≈ %1</translation>
    </message>
    <message>
        <source>no data</source>
        <extracomment>In place of an elevation: the map has none there</extracomment>
        <translation>keine Daten</translation>
    </message>
    <message>
        <source>Read from a preview; exact once the overviews are built</source>
        <translation>Aus einer Vorschau gelesen; genau, sobald die Übersichten erstellt sind</translation>
    </message>
    <message>
        <source>Read from a coarser level; the samples here are being read</source>
        <translation>Aus einer gröberen Stufe gelesen; die Abtastwerte hier werden gerade gelesen</translation>
    </message>
</context>
<context>
    <name>marsview::StereonetPlot</name>
    <message>
        <source>Stereonet</source>
        <translation>Lagenkugel</translation>
    </message>
    <message>
        <source>Equal-area net, lower hemisphere. Click a pole to select its plane</source>
        <translation>Flächentreues Netz, untere Halbkugel. Klicken Sie auf einen Pol, um seine Ebene auszuwählen</translation>
    </message>
    <message>
        <source>N</source>
        <extracomment>North, on diagrams</extracomment>
        <translation>N</translation>
    </message>
</context>
<context>
    <name>marsview::StretchDialog</name>
    <message>
        <source>&amp;Current View</source>
        <translation>&amp;Aktuelle Ansicht</translation>
    </message>
    <message>
        <source>Automatic</source>
        <extracomment>A color stretch</extracomment>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Full range</source>
        <extracomment>A color stretch</extracomment>
        <translation>Ganzer Bereich</translation>
    </message>
    <message>
        <source>Percentile</source>
        <extracomment>A color stretch</extracomment>
        <translation>Perzentil</translation>
    </message>
    <message>
        <source>Minimum and maximum</source>
        <extracomment>A color stretch</extracomment>
        <translation>Minimum und Maximum</translation>
    </message>
    <message>
        <source>Color stretch</source>
        <translation>Farbspreizung</translation>
    </message>
    <message>
        <source> %</source>
        <extracomment>Percent, after a number</extracomment>
        <translation> %</translation>
    </message>
    <message>
        <source>Percentage cut off at either end</source>
        <translation>Prozentsatz, der an jedem Ende abgeschnitten wird</translation>
    </message>
    <message>
        <source>Minimum elevation</source>
        <translation>Kleinste Höhe</translation>
    </message>
    <message>
        <source>Maximum elevation</source>
        <translation>Größte Höhe</translation>
    </message>
    <message>
        <source>Use the elevations that the picture shows now</source>
        <translation>Die Höhen benutzen, die das Bild jetzt zeigt</translation>
    </message>
    <message>
        <source>&amp;Stretch</source>
        <translation>&amp;Spreizung</translation>
    </message>
    <message>
        <source>Cut at &amp;either end</source>
        <translation>An jedem &amp;Ende abschneiden</translation>
    </message>
    <message>
        <source>M&amp;inimum</source>
        <translation>M&amp;inimum</translation>
    </message>
    <message>
        <source>M&amp;aximum</source>
        <translation>M&amp;aximum</translation>
    </message>
    <message>
        <source>Color Stretch — %1</source>
        <extracomment>Title of a window; %1 is a layer</extracomment>
        <translation>Farbspreizung — %1</translation>
    </message>
    <message>
        <source>Color Stretch</source>
        <translation>Farbspreizung</translation>
    </message>
    <message>
        <source>Histogram of slopes</source>
        <translation>Histogramm der Neigungen</translation>
    </message>
    <message>
        <source>Histogram of elevations</source>
        <translation>Histogramm der Höhen</translation>
    </message>
    <message>
        <source>Minimum slope</source>
        <translation>Kleinste Neigung</translation>
    </message>
    <message>
        <source>Maximum slope</source>
        <translation>Größte Neigung</translation>
    </message>
    <message>
        <source>Slopes averaged over the map&apos;s overview; single samples may be steeper.</source>
        <translation>Neigungen, gemittelt über die Übersicht der Karte; einzelne Stellen können steiler sein.</translation>
    </message>
    <message>
        <source>All samples have the same elevation.</source>
        <translation>Alle Abtastwerte haben dieselbe Höhe.</translation>
    </message>
    <message>
        <source>This ramp is symmetric about 0: its ends are %1.</source>
        <extracomment>%1 is a range of elevations</extracomment>
        <translation>Diese Skala ist symmetrisch um 0: Ihre Enden sind %1.</translation>
    </message>
    <message>
        <source>The minimum must be below the maximum.</source>
        <translation>Das Minimum muss unter dem Maximum liegen.</translation>
    </message>
</context>
<context>
    <name>marsview::StretchPlot</name>
    <message>
        <source>Histogram</source>
        <translation>Histogramm</translation>
    </message>
    <message>
        <source>The lines mark the ends of the color stretch</source>
        <translation>Die Linien markieren die Enden der Farbspreizung</translation>
    </message>
    <message>
        <source>Drag the lines to change the ends of the color stretch</source>
        <translation>Ziehen Sie die Linien, um die Enden der Farbspreizung zu ändern</translation>
    </message>
</context>
<context>
    <name>marsview::SunFields</name>
    <message>
        <source>The sun is overhead at</source>
        <extracomment>Above the fields for a latitude and a longitude</extracomment>
        <translation>Die Sonne steht im Zenit bei</translation>
    </message>
    <message>
        <source>&amp;Sun Overhead at the Picture’s Center</source>
        <translation>&amp;Sonne im Zenit der Bildmitte</translation>
    </message>
    <message>
        <source>Latitude of the subsolar point</source>
        <translation>Breite des subsolaren Punkts</translation>
    </message>
    <message>
        <source>Longitude of the subsolar point</source>
        <translation>Länge des subsolaren Punkts</translation>
    </message>
    <message>
        <source>Light the place in the middle of the picture from straight above</source>
        <translation>Den Ort in der Bildmitte senkrecht von oben beleuchten</translation>
    </message>
    <message>
        <source>L&amp;atitude</source>
        <translation>&amp;Breite</translation>
    </message>
    <message>
        <source>Lon&amp;gitude</source>
        <translation>&amp;Länge</translation>
    </message>
    <message>
        <source>The sun is overhead at this place. Type degrees, or degrees, minutes and seconds.</source>
        <translation>Die Sonne steht an diesem Ort im Zenit. Geben Sie Grad oder Grad, Minuten und Sekunden ein.</translation>
    </message>
    <message>
        <source>The sun is overhead at this place. Type degrees, or degrees, minutes and seconds. The latitude is %1.</source>
        <extracomment>%1 is a kind of latitude, such as planetocentric</extracomment>
        <translation>Die Sonne steht an diesem Ort im Zenit. Geben Sie Grad oder Grad, Minuten und Sekunden ein. Die Breite ist %1.</translation>
    </message>
    <message>
        <source>Latitudes range from 90° S to 90° N.</source>
        <translation>Breiten reichen von 90° S bis 90° N.</translation>
    </message>
    <message>
        <source>Longitudes range from 360° W to 360° E.</source>
        <translation>Längen reichen von 360° W bis 360° O.</translation>
    </message>
    <message>
        <source>This is not a latitude, such as %1.</source>
        <extracomment>%1 is an example</extracomment>
        <translation>Das ist keine Breite wie %1.</translation>
    </message>
    <message>
        <source>This is not a longitude, such as %1.</source>
        <extracomment>%1 is an example</extracomment>
        <translation>Das ist keine Länge wie %1.</translation>
    </message>
</context>
<context>
    <name>marsview::TerrainView</name>
    <message>
        <source>Map</source>
        <translation>Karte</translation>
    </message>
    <message>
        <source>The terrain in perspective; the status bar shows the position and elevation under the pointer or the stylus, or at the crosshair in the middle while the keyboard is used</source>
        <translation>Das Gelände in Perspektive; die Statusleiste zeigt Position und Höhe unter dem Zeiger oder dem Stift, oder am Fadenkreuz in der Mitte, wenn die Tastatur benutzt wird</translation>
    </message>
    <message>
        <source>All layers are hidden; check one in the list of layers</source>
        <extracomment>Shown in the middle of the window while no layer has a check mark</extracomment>
        <translation>Alle Layer sind ausgeblendet; setzen Sie in der Liste der Layer ein Häkchen</translation>
    </message>
    <message>
        <source>Drop a DEM here or press Ctrl+O</source>
        <extracomment>Shown while no map is open. DEM = digital elevation model.</extracomment>
        <translation>Legen Sie hier ein Geländemodell ab, oder drücken Sie Strg+O</translation>
    </message>
    <message>
        <source>no OpenGL context can be created; install the graphics driver, or Mesa&apos;s software one (libgl1-mesa-dri)</source>
        <translation>Es kann kein OpenGL-Kontext erzeugt werden; installieren Sie den Grafiktreiber oder den Softwaretreiber von Mesa (libgl1-mesa-dri)</translation>
    </message>
</context>
<context>
    <name>marsview::TouchRecorder</name>
    <message>
        <source>%1: nothing to record; connect a device and open a map</source>
        <translation>%1: nichts aufzuzeichnen; verbinden Sie ein Gerät und öffnen Sie eine Karte</translation>
    </message>
</context>
<context>
    <name>marsview::VectorFileList</name>
    <message>
        <source>Vector files, topmost first</source>
        <translation>Vektordateien, oberste zuerst</translation>
    </message>
    <message>
        <source>Vector files</source>
        <translation>Vektordateien</translation>
    </message>
</context>
<context>
    <name>marsview::VectorOverlays</name>
    <message>
        <source>Reading %1</source>
        <extracomment>In the status bar: %1 is a file</extracomment>
        <translation>%1 wird gelesen</translation>
    </message>
</context>
<context>
    <name>marsview::VectorTools</name>
    <message>
        <source>%1: there is no map to draw it on; open a map first</source>
        <translation>%1: Es gibt keine Karte, auf der sie gezeichnet werden kann; öffnen Sie zuerst eine</translation>
    </message>
    <message>
        <source>Open Vector File</source>
        <translation>Vektordatei öffnen</translation>
    </message>
    <message>
        <source>Vector files (*.gpkg *.geojson *.json *.kml *.shp *.csv)</source>
        <translation>Vektordateien (*.gpkg *.geojson *.json *.kml *.shp *.csv)</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>%1 says that it is in longitude and latitude on Earth, but the map is on %2</source>
        <extracomment>%1 is a file, %2 is a body</extracomment>
        <translation>%1 gibt Länge und Breite auf der Erde an, aber die Karte liegt auf %2</translation>
    </message>
    <message>
        <source>Use %1</source>
        <extracomment>On a button: read a file as longitude and latitude on that body; %1 is a body</extracomment>
        <translation>%1 benutzen</translation>
    </message>
    <message>
        <source>Opened %1</source>
        <extracomment>In the status bar, for a few seconds; %1 is a file</extracomment>
        <translation>%1 geöffnet</translation>
    </message>
    <message>
        <source>&amp;Show</source>
        <translation>&amp;Zeigen</translation>
    </message>
    <message>
        <source>&amp;Go There</source>
        <translation>&amp;Gehe dorthin</translation>
    </message>
    <message>
        <source>&amp;Color…</source>
        <translation>&amp;Farbe …</translation>
    </message>
    <message>
        <source>C&amp;lose</source>
        <translation>&amp;Schließen</translation>
    </message>
    <message>
        <source>Hidden: on another body</source>
        <extracomment>In the row of a vector file, why it is not drawn</extracomment>
        <translation>Ausgeblendet: auf einem anderen Himmelskörper</translation>
    </message>
</context>
<context>
    <name>marsview::ViewCommands</name>
    <message>
        <source>Cannot Draw</source>
        <translation>Zeichnen ist nicht möglich</translation>
    </message>
</context>
<context>
    <name>marsview::WindowActions</name>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation>&amp;Öffnen …</translation>
    </message>
    <message>
        <source>Open a map as a new layer (%1)</source>
        <translation>Eine Karte als neuen Layer öffnen (%1)</translation>
    </message>
    <message>
        <source>Open &amp;Folder…</source>
        <translation>&amp;Ordner öffnen …</translation>
    </message>
    <message>
        <source>Open the adjoining rasters in a folder as one map</source>
        <translation>Die aneinandergrenzenden Raster eines Ordners als eine Karte öffnen</translation>
    </message>
    <message>
        <source>Open &amp;Address…</source>
        <translation>&amp;Adresse öffnen …</translation>
    </message>
    <message>
        <source>Open a cloud-optimized GeoTIFF on a server</source>
        <translation>Ein cloud-optimiertes GeoTIFF auf einem Server öffnen</translation>
    </message>
    <message>
        <source>Open Na&amp;mes…</source>
        <translation>Na&amp;men öffnen …</translation>
    </message>
    <message>
        <source>Open a file of named points to find and show on the map</source>
        <translation>Eine Datei benannter Punkte öffnen, die gesucht und auf der Karte gezeigt werden</translation>
    </message>
    <message>
        <source>Open Vector Fi&amp;le…</source>
        <translation>&amp;Vektordatei öffnen …</translation>
    </message>
    <message>
        <source>Draw points, lines and polygons of a file on the terrain</source>
        <translation>Punkte, Linien und Flächen einer Datei auf das Gelände zeichnen</translation>
    </message>
    <message>
        <source>Open &amp;Recent</source>
        <translation>Zu&amp;letzt geöffnet</translation>
    </message>
    <message>
        <source>Open &amp;Bundled Map</source>
        <translation>Beis&amp;pielkarte öffnen</translation>
    </message>
    <message>
        <source>Save &amp;Picture…</source>
        <translation>&amp;Bild speichern …</translation>
    </message>
    <message>
        <source>Save what the map shows as a picture</source>
        <translation>Speichern, was die Karte zeigt, als Bild</translation>
    </message>
    <message>
        <source>&amp;Cancel Loading</source>
        <translation>Laden abbre&amp;chen</translation>
    </message>
    <message>
        <source>S&amp;top Building Overviews</source>
        <translation>Erstellen der Übersichten an&amp;halten</translation>
    </message>
    <message>
        <source>Stop building the overviews of a large map; it can be resumed later</source>
        <translation>Das Erstellen der Übersichten einer großen Karte anhalten; es kann später fortgesetzt werden</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>B&amp;eenden</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>&amp;Copy Coordinates</source>
        <translation>&amp;Koordinaten kopieren</translation>
    </message>
    <message>
        <source>Copy the position under the pointer, or under the crosshair, to the clipboard</source>
        <translation>Die Position unter dem Zeiger oder dem Fadenkreuz in die Zwischenablage kopieren</translation>
    </message>
    <message>
        <source>&amp;Preferences…</source>
        <translation>&amp;Einstellungen …</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>&amp;Home</source>
        <translation>&amp;Ganze Karte</translation>
    </message>
    <message>
        <source>Show the whole map from the south (Home)</source>
        <translation>Die ganze Karte von Süden zeigen (Pos1)</translation>
    </message>
    <message>
        <source>&amp;North Up</source>
        <translation>&amp;Norden oben</translation>
    </message>
    <message>
        <source>North</source>
        <translation>Norden</translation>
    </message>
    <message>
        <source>Turn north to the top (N)</source>
        <translation>Norden nach oben drehen (N)</translation>
    </message>
    <message>
        <source>&amp;Go to Place…</source>
        <translation>Gehe zu &amp;Ort …</translation>
    </message>
    <message>
        <source>Go to a name or a coordinate</source>
        <translation>Zu einem Namen oder einer Koordinate gehen</translation>
    </message>
    <message>
        <source>Fin&amp;d Name</source>
        <translation>Namen &amp;suchen</translation>
    </message>
    <message>
        <source>Search for the name of a place</source>
        <translation>Nach dem Namen eines Orts suchen</translation>
    </message>
    <message>
        <source>Coordinate &amp;Format</source>
        <translation>Koordinaten&amp;format</translation>
    </message>
    <message>
        <source>&amp;Move</source>
        <translation>&amp;Bewegen</translation>
    </message>
    <message>
        <source>E&amp;xaggerate More</source>
        <translation>S&amp;tärker überhöhen</translation>
    </message>
    <message>
        <source>Exaggerate &amp;Less</source>
        <translation>S&amp;chwächer überhöhen</translation>
    </message>
    <message>
        <source>&amp;Panels</source>
        <translation>Bedienfe&amp;lder</translation>
    </message>
    <message>
        <source>&amp;Next Panel</source>
        <translation>&amp;Nächstes Bedienfeld</translation>
    </message>
    <message>
        <source>Move the keyboard focus to the next panel or the map</source>
        <translation>Den Tastaturfokus zum nächsten Bedienfeld oder zur Karte bewegen</translation>
    </message>
    <message>
        <source>&amp;Previous Panel</source>
        <translation>&amp;Voriges Bedienfeld</translation>
    </message>
    <message>
        <source>Move the keyboard focus to the previous panel or the map</source>
        <translation>Den Tastaturfokus zum vorigen Bedienfeld oder zur Karte bewegen</translation>
    </message>
    <message>
        <source>Full &amp;Screen</source>
        <translation>&amp;Vollbild</translation>
    </message>
    <message>
        <source>&amp;Tool</source>
        <extracomment>What the left mouse button does</extracomment>
        <translation>&amp;Werkzeug</translation>
    </message>
    <message>
        <source>&amp;Map</source>
        <translation>&amp;Karte</translation>
    </message>
    <message>
        <source>&amp;Shading</source>
        <translation>&amp;Schattierung</translation>
    </message>
    <message>
        <source>&amp;Contour Lines</source>
        <translation>&amp;Höhenlinien</translation>
    </message>
    <message>
        <source>Contour &amp;Interval…</source>
        <translation>Äqui&amp;distanz …</translation>
    </message>
    <message>
        <source>Enter the elevation between two contour lines</source>
        <translation>Den Höhenabstand zwischen zwei Höhenlinien eingeben</translation>
    </message>
    <message>
        <source>&amp;Color Ramp</source>
        <translation>&amp;Farbskala</translation>
    </message>
    <message>
        <source>Automatic</source>
        <extracomment>A color ramp: the one that suits the map&apos;s body</extracomment>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>&amp;Light…</source>
        <translation>&amp;Licht …</translation>
    </message>
    <message>
        <source>Choose where the light comes from</source>
        <translation>Wählen, woher das Licht kommt</translation>
    </message>
    <message>
        <source>&amp;Layer</source>
        <translation>&amp;Layer</translation>
    </message>
    <message>
        <source>Show La&amp;yer</source>
        <translation>&amp;Layer zeigen</translation>
    </message>
    <message>
        <source>&amp;Go to Layer</source>
        <translation>&amp;Gehe zum Layer</translation>
    </message>
    <message>
        <source>Re&amp;name Layer</source>
        <translation>Layer &amp;umbenennen</translation>
    </message>
    <message>
        <source>Move Layer &amp;Up</source>
        <translation>Layer nach &amp;oben</translation>
    </message>
    <message>
        <source>Move Layer &amp;Down</source>
        <translation>Layer nach u&amp;nten</translation>
    </message>
    <message>
        <source>&amp;Finest Layer on Top</source>
        <extracomment>Of layers that overlap</extracomment>
        <translation>&amp;Feinster Layer zuoberst</translation>
    </message>
    <message>
        <source>Where layers overlap, show, read and touch the one with the smallest pixels, instead of the upper one in the list</source>
        <translation>Wo Layer sich überlappen, den mit den kleinsten Pixeln zeigen, ablesen und ertasten statt des oberen in der Liste</translation>
    </message>
    <message>
        <source>&amp;Build Overviews</source>
        <translation>Ü&amp;bersichten erstellen</translation>
    </message>
    <message>
        <source>Build the overviews of a large map, to see and touch all of it</source>
        <translation>Die Übersichten einer großen Karte erstellen, um sie ganz zu sehen und zu ertasten</translation>
    </message>
    <message>
        <source>E&amp;xport Contours…</source>
        <translation>Höhenlinien e&amp;xportieren …</translation>
    </message>
    <message>
        <source>Save the contours of the layer at full resolution as a vector file</source>
        <translation>Die Höhenlinien des Layers in voller Auflösung als Vektordatei speichern</translation>
    </message>
    <message>
        <source>Set Body, &amp;CRS…</source>
        <translation>&amp;Raumbezug festlegen …</translation>
    </message>
    <message>
        <source>Set body, CRS, elevation unit and more for a file that lacks them</source>
        <translation>Himmelskörper, KBS, Höheneinheit und mehr für eine Datei festlegen, der sie fehlen</translation>
    </message>
    <message>
        <source>&amp;Vector Files</source>
        <translation>&amp;Vektordateien</translation>
    </message>
    <message>
        <source>Show, find, color or close open vector files</source>
        <translation>Geöffnete Vektordateien zeigen, suchen, färben oder schließen</translation>
    </message>
    <message>
        <source>R&amp;emove Layer</source>
        <translation>Layer &amp;entfernen</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Color S&amp;tretch</source>
        <translation>Farbs&amp;preizung</translation>
    </message>
    <message>
        <source>&amp;Stretch to Current View</source>
        <translation>Auf aktuelle Ansicht &amp;spreizen</translation>
    </message>
    <message>
        <source>Spread the color ramp over the elevations that the picture shows now</source>
        <translation>Die Farbskala über die Höhen spreizen, die das Bild jetzt zeigt</translation>
    </message>
    <message>
        <source>&amp;Edit Stretch…</source>
        <translation>Spreizung &amp;bearbeiten …</translation>
    </message>
    <message>
        <source>Show the histogram of the layer with the ends of the stretch</source>
        <translation>Das Histogramm des Layers mit den Enden der Spreizung zeigen</translation>
    </message>
    <message>
        <source>Ha&amp;ptics</source>
        <translation>&amp;Haptik</translation>
    </message>
    <message>
        <source>&amp;Contact Model</source>
        <translation>&amp;Kontaktmodell</translation>
    </message>
    <message>
        <source>How the point of contact follows the stylus over the terrain</source>
        <translation>Wie der Punkt, der den Boden berührt, der Hand folgt</translation>
    </message>
    <message>
        <source>So&amp;und of Touch</source>
        <translation>&amp;Ton der Berührung</translation>
    </message>
    <message>
        <source>Hear the terrain that is touched: the force as a tone, its roughness as a hiss</source>
        <translation>Das berührte Gelände hören: die Kraft als Ton, seine Rauheit als Zischen</translation>
    </message>
    <message>
        <source>&amp;Devices…</source>
        <translation>&amp;Geräte …</translation>
    </message>
    <message>
        <source>Connect a haptic device and set stiffness and force</source>
        <translation>Ein haptisches Gerät verbinden und Steifigkeit und Kraft einstellen</translation>
    </message>
    <message>
        <source>&amp;Record Touch…</source>
        <translation>Berührung auf&amp;zeichnen …</translation>
    </message>
    <message>
        <source>Record the motion of the device&apos;s stylus in a file</source>
        <translation>Die Bewegung des Stifts in einer Datei aufzeichnen</translation>
    </message>
    <message>
        <source>Re&amp;play Touch…</source>
        <translation>Berührung ab&amp;spielen …</translation>
    </message>
    <message>
        <source>Play back a recording in place of a device</source>
        <translation>Eine Aufzeichnung anstelle eines Geräts abspielen</translation>
    </message>
    <message>
        <source>Save Diagnostic &amp;Log…</source>
        <translation>&amp;Diagnoseprotokoll speichern …</translation>
    </message>
    <message>
        <source>Save the last ten seconds of the device, tick by tick, for troubleshooting</source>
        <translation>Die letzten zehn Sekunden des Geräts Takt für Takt speichern, zur Fehlersuche</translation>
    </message>
    <message>
        <source>Emergency &amp;Stop</source>
        <translation>&amp;Notaus</translation>
    </message>
    <message>
        <source>Switch all forces off at once</source>
        <translation>Alle Kräfte sofort abschalten</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>H&amp;ilfe</translation>
    </message>
    <message>
        <source>User &amp;Guide</source>
        <translation>&amp;Benutzerhandbuch</translation>
    </message>
    <message>
        <source>&amp;Keys and Mouse</source>
        <translation>&amp;Tastatur und Maus</translation>
    </message>
    <message>
        <source>&amp;What&apos;s This?</source>
        <translation>&amp;Was ist das?</translation>
    </message>
    <message>
        <source>&amp;About MarsView</source>
        <translation>&amp;Über MarsView</translation>
    </message>
    <message>
        <source>Mea&amp;sure</source>
        <translation>&amp;Messen</translation>
    </message>
    <message>
        <source>&amp;Profile</source>
        <translation>&amp;Profil</translation>
    </message>
    <message>
        <source>Click along a line: its elevations, lengths and slopes</source>
        <translation>Klicken Sie entlang einer Linie: ihre Höhen, Längen und Neigungen</translation>
    </message>
    <message>
        <source>&amp;Distance</source>
        <translation>&amp;Entfernung</translation>
    </message>
    <message>
        <source>Click along a line: its length on the body and along the terrain</source>
        <translation>Klicken Sie entlang einer Linie: ihre Länge auf dem Himmelskörper und entlang des Geländes</translation>
    </message>
    <message>
        <source>&amp;Area and Volume</source>
        <translation>&amp;Fläche und Volumen</translation>
    </message>
    <message>
        <source>Click around an area: its size, and the volume above and below the plane through its border</source>
        <translation>Klicken Sie um eine Fläche: ihre Größe und das Volumen über und unter der Ebene durch ihren Rand</translation>
    </message>
    <message>
        <source>&amp;Strike and Dip</source>
        <translation>&amp;Streichen und Fallen</translation>
    </message>
    <message>
        <source>Click three or more points on a layer of rock: the plane through them</source>
        <translation>Klicken Sie drei oder mehr Punkte auf einer Gesteinsschicht: die Ebene durch sie</translation>
    </message>
    <message>
        <source>&amp;Crater</source>
        <translation>&amp;Krater</translation>
    </message>
    <message>
        <source>Click three or more points on the rim: diameter and depth</source>
        <translation>Klicken Sie drei oder mehr Punkte auf dem Rand: Durchmesser und Tiefe</translation>
    </message>
    <message>
        <source>&amp;Elevation and Slope</source>
        <translation>&amp;Höhe und Neigung</translation>
    </message>
    <message>
        <source>Click a point: its elevation, slope and aspect</source>
        <translation>Klicken Sie einen Punkt: seine Höhe, Neigung und Exposition</translation>
    </message>
    <message>
        <source>Add Point &amp;by Coordinates…</source>
        <translation>Punkt mit Koordinaten hin&amp;zufügen …</translation>
    </message>
    <message>
        <source>Type the coordinates of the next point, or a name</source>
        <translation>Die Koordinaten des nächsten Punkts oder einen Namen eingeben</translation>
    </message>
    <message>
        <source>&amp;Finish Measurement</source>
        <translation>Messung &amp;abschließen</translation>
    </message>
    <message>
        <source>The next click begins another measurement</source>
        <translation>Der nächste Klick beginnt eine neue Messung</translation>
    </message>
    <message>
        <source>&amp;Remove Measurement</source>
        <translation>Messung entfer&amp;nen</translation>
    </message>
    <message>
        <source>Remove A&amp;ll Measurements</source>
        <translation>A&amp;lle Messungen entfernen</translation>
    </message>
    <message>
        <source>Not available: the selected layer is not in the picture. Show it first</source>
        <translation>Nicht verfügbar: Der ausgewählte Layer ist nicht im Bild. Zeigen Sie ihn zuerst</translation>
    </message>
    <message>
        <source>&amp;Annotate</source>
        <translation>Anme&amp;rken</translation>
    </message>
    <message>
        <source>&amp;Point</source>
        <extracomment>An annotation</extracomment>
        <translation>&amp;Punkt</translation>
    </message>
    <message>
        <source>Click to mark a place with a symbol and a name</source>
        <translation>Klicken, um eine Stelle mit Symbol und Namen zu markieren</translation>
    </message>
    <message>
        <source>&amp;Line</source>
        <extracomment>An annotation</extracomment>
        <translation>&amp;Linie</translation>
    </message>
    <message>
        <source>Click along a line; a double click finishes it</source>
        <translation>Entlang einer Linie klicken; ein Doppelklick beendet sie</translation>
    </message>
    <message>
        <source>P&amp;olygon</source>
        <extracomment>An annotation</extracomment>
        <translation>P&amp;olygon</translation>
    </message>
    <message>
        <source>Click around an area; a double click finishes it</source>
        <translation>Um eine Fläche herum klicken; ein Doppelklick beendet sie</translation>
    </message>
    <message>
        <source>&amp;Finish Annotation</source>
        <translation>Anmerkung &amp;beenden</translation>
    </message>
    <message>
        <source>The next click begins another annotation</source>
        <translation>Der nächste Klick beginnt eine andere Anmerkung</translation>
    </message>
    <message>
        <source>&amp;Remove Annotations</source>
        <translation>Anmerkungen &amp;entfernen</translation>
    </message>
    <message>
        <source>Remove the annotations that are selected in the panel; Undo brings them back</source>
        <translation>Entfernt die Anmerkungen, die im Bedienfeld ausgewählt sind; Rückgängig holt sie zurück</translation>
    </message>
    <message>
        <source>&amp;Import…</source>
        <translation>&amp;Importieren …</translation>
    </message>
    <message>
        <source>Add the points, lines and polygons of a GeoPackage, GeoJSON, KML, Shapefile or CSV file</source>
        <translation>Punkte, Linien und Polygone einer GeoPackage-, GeoJSON-, KML-, Shapefile- oder CSV-Datei hinzufügen</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation>E&amp;xportieren …</translation>
    </message>
    <message>
        <source>Save the annotations as GeoPackage, GeoJSON, KML, Shapefile or CSV</source>
        <translation>Die Anmerkungen als GeoPackage, GeoJSON, KML, Shapefile oder CSV speichern</translation>
    </message>
    <message>
        <source>Zoom &amp;In</source>
        <translation>Ver&amp;größern</translation>
    </message>
    <message>
        <source>Zoom &amp;Out</source>
        <translation>Ver&amp;kleinern</translation>
    </message>
    <message>
        <source>Pan &amp;Left</source>
        <translation>Nach &amp;links</translation>
    </message>
    <message>
        <source>Pan &amp;Right</source>
        <translation>Nach &amp;rechts</translation>
    </message>
    <message>
        <source>Pan &amp;Forward</source>
        <translation>Nach &amp;vorn</translation>
    </message>
    <message>
        <source>Pan &amp;Back</source>
        <translation>Nach &amp;hinten</translation>
    </message>
    <message>
        <source>&amp;Turn Left</source>
        <translation>L&amp;inks drehen</translation>
    </message>
    <message>
        <source>T&amp;urn Right</source>
        <translation>R&amp;echts drehen</translation>
    </message>
    <message>
        <source>Tilt U&amp;p</source>
        <translation>Nach &amp;oben neigen</translation>
    </message>
    <message>
        <source>Tilt &amp;Down</source>
        <translation>Nach &amp;unten neigen</translation>
    </message>
    <message>
        <source>&amp;Shaded Relief</source>
        <extracomment>Colors by elevation, with light and shade</extracomment>
        <translation>&amp;Schattiertes Relief</translation>
    </message>
    <message>
        <source>&amp;Hillshade</source>
        <extracomment>Light and shade alone</extracomment>
        <translation>Schu&amp;mmerung</translation>
    </message>
    <message>
        <source>S&amp;lope</source>
        <extracomment>Colors by steepness</extracomment>
        <translation>&amp;Neigung</translation>
    </message>
    <message>
        <source>&amp;Automatic</source>
        <extracomment>A color stretch: ignores the rarest elevations at either end
----------
A scene: the one that suits the layers</extracomment>
        <translation>&amp;Automatisch</translation>
    </message>
    <message>
        <source>Spread the color ramp over all but the rarest half percent of elevations at either end</source>
        <translation>Die Farbskala über alle Höhen außer dem seltensten halben Prozent an jedem Ende spreizen</translation>
    </message>
    <message>
        <source>Spread the color ramp over all but the steepest percent of the slopes</source>
        <translation>Die Farbskala über alle Neigungen außer dem steilsten Prozent spreizen</translation>
    </message>
    <message>
        <source>&amp;Full Range</source>
        <extracomment>A color stretch</extracomment>
        <translation>&amp;Ganzer Bereich</translation>
    </message>
    <message>
        <source>Spread the color ramp from the lowest to the highest elevation of the layer</source>
        <translation>Die Farbskala von der tiefsten bis zur höchsten Höhe des Layers spreizen</translation>
    </message>
    <message>
        <source>&amp;Percentile…</source>
        <extracomment>A color stretch: so many percent are cut off at either end</extracomment>
        <translation>&amp;Perzentil …</translation>
    </message>
    <message>
        <source>Cut off a percentage of the elevations at either end</source>
        <translation>Einen Prozentsatz der Höhen an jedem Ende abschneiden</translation>
    </message>
    <message>
        <source>&amp;Minimum and Maximum…</source>
        <extracomment>A color stretch: minimum and maximum are typed</extracomment>
        <translation>&amp;Minimum und Maximum …</translation>
    </message>
    <message>
        <source>Enter the values at the ends of the color ramp</source>
        <translation>Die Werte an den Enden der Farbskala eingeben</translation>
    </message>
    <message>
        <source>Enter the slopes at the ends of the color ramp</source>
        <translation>Die Neigungen an den Enden der Farbskala eingeben</translation>
    </message>
    <message>
        <source>&amp;Continuous Walk (exact)</source>
        <extracomment>A contact model: how the touching point (the proxy) follows the hand over the ground</extracomment>
        <translation>&amp;Stetiger Gang (genau)</translation>
    </message>
    <message>
        <source>Takes every point of the hand&apos;s way in turn, so that even fast strokes end where slow ones would; each costs a little more time</source>
        <extracomment>Status tip of a contact model: its behavior and its cost</extracomment>
        <translation>Nimmt jeden Punkt des Wegs der Hand der Reihe nach, sodass auch schnelle Striche enden, wo langsame es täten; jeder kostet etwas mehr Zeit</translation>
    </message>
    <message>
        <source>&amp;Surface Walk</source>
        <extracomment>A contact model: how the touching point (the proxy) follows the hand over the ground</extracomment>
        <translation>&amp;Oberflächengang</translation>
    </message>
    <message>
        <source>Slides downhill across faces, edges and corners of the ground; quick, but a fast stroke may end in a neighboring dip</source>
        <extracomment>Status tip of a contact model: its behavior and its cost</extracomment>
        <translation>Gleitet bergab über Flächen, Kanten und Ecken des Bodens; schnell, aber ein schneller Strich kann in einer benachbarten Senke enden</translation>
    </message>
    <message>
        <source>&amp;Proxy Graph</source>
        <extracomment>A contact model: it walks on the graph of the vertices and edges of the ground</extracomment>
        <translation>&amp;Proxy-Graph</translation>
    </message>
    <message>
        <source>Goes along edges from corner to corner and on across faces; quick, but a fast stroke ends in a neighboring dip more often</source>
        <extracomment>Status tip of a contact model: its behavior and its cost</extracomment>
        <translation>Geht entlang der Kanten von Ecke zu Ecke und weiter über Flächen; schnell, aber ein schneller Strich endet öfter in einer benachbarten Senke</translation>
    </message>
    <message>
        <source>Proxy Graph as Published (&amp;2003)</source>
        <extracomment>A contact model: the proxy graph exactly as its paper describes it</extracomment>
        <translation>Proxy-Graph wie veröffentlicht (&amp;2003)</translation>
    </message>
    <message>
        <source>Follows the rules of the 2003 paper to the letter, for comparison; it rests farther from the nearest point than the others do</source>
        <extracomment>Status tip of a contact model: its behavior and its cost</extracomment>
        <translation>Befolgt die Regeln des Artikels von 2003 wörtlich, zum Vergleich; ruht weiter vom nächsten Punkt entfernt als die anderen</translation>
    </message>
    <message>
        <source>&amp;God-Object</source>
        <extracomment>A contact model, by the name that the literature gave it</extracomment>
        <translation>&amp;God-Object</translation>
    </message>
    <message>
        <source>Stops at each face that it hits until the hand moves again; simple, but it may stick or float for a moment</source>
        <extracomment>Status tip of a contact model: its behavior and its cost</extracomment>
        <translation>Hält an jeder Fläche, auf die es trifft, bis sich die Hand wieder bewegt; einfach, kann aber kurz hängen bleiben oder schweben</translation>
    </message>
    <message>
        <source>God-Object, Constraints &amp;Released</source>
        <extracomment>A contact model: a god-object that releases constraints</extracomment>
        <translation>God-Object, &amp;Bedingungen gelöst</translation>
    </message>
    <message>
        <source>A god-object that releases faces as soon as they no longer hold it; it does not stick, but searches for every face that it reaches</source>
        <extracomment>Status tip of a contact model: its behavior and its cost</extracomment>
        <translation>Ein God-Object, das Flächen loslässt, sobald sie es nicht mehr halten; es bleibt nicht hängen, sucht aber nach jeder Fläche, die es erreicht</translation>
    </message>
    <message>
        <source>&amp;Virtual Proxy (sphere)</source>
        <extracomment>A contact model: a sphere touches the ground in place of a point</extracomment>
        <translation>&amp;Virtueller Proxy (Kugel)</translation>
    </message>
    <message>
        <source>Touches with a sphere as wide as a cell of the map; it rounds off sharp ridges, but does not reach into narrow dips</source>
        <extracomment>Status tip of a contact model: its behavior and its cost</extracomment>
        <translation>Tastet mit einer Kugel, so breit wie eine Zelle der Karte; rundet scharfe Grate ab, reicht aber nicht in enge Senken</translation>
    </message>
    <message>
        <source>Sc&amp;ene</source>
        <extracomment>How the terrain is laid out: in a plane, or on its body</extracomment>
        <translation>Sz&amp;ene</translation>
    </message>
    <message>
        <source>The globe where layers have several CRSs or cover a tenth of their body, otherwise the flat map</source>
        <translation>Der Globus, wo Ebenen mehrere KBS haben oder ein Zehntel ihres Körpers bedecken, sonst die ebene Karte</translation>
    </message>
    <message>
        <source>&amp;Flat Map</source>
        <extracomment>A scene</extracomment>
        <translation>&amp;Ebene Karte</translation>
    </message>
    <message>
        <source>Lay the topmost layer out in the plane of its CRS</source>
        <translation>Den obersten Layer in der Ebene seines KBS zeigen</translation>
    </message>
    <message>
        <source>&amp;Globe</source>
        <extracomment>A scene: the topmost layer where it lies on its body</extracomment>
        <translation>&amp;Globus</translation>
    </message>
    <message>
        <source>Show the topmost layer where it lies on its body</source>
        <translation>Den obersten Layer dort zeigen, wo er auf seinem Himmelskörper liegt</translation>
    </message>
    <message>
        <source>&amp;Switch to Globe or Back</source>
        <extracomment>In the menu of scenes: shows the globe, or the flat map again</extracomment>
        <translation>&amp;Zum Globus und zurück wechseln</translation>
    </message>
    <message>
        <source>Globe</source>
        <translation>Globus</translation>
    </message>
</context>
<context>
    <name>marsview::WindowDocks</name>
    <message>
        <source>Layers</source>
        <translation>Layer</translation>
    </message>
    <message>
        <source>Georeferencing</source>
        <translation>Georeferenzierung</translation>
    </message>
    <message>
        <source>Haptics</source>
        <translation>Haptik</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Ansichten</translation>
    </message>
    <message>
        <source>Annotations</source>
        <translation>Anmerkungen</translation>
    </message>
</context>
<context>
    <name>marsview::WindowMessages</name>
    <message>
        <source>Saved %1</source>
        <extracomment>In the status bar, for a few seconds; %1 is a file</extracomment>
        <translation>%1 gespeichert</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <extracomment>A failure: %1 is what was not done, such as &quot;Cannot Open Map&quot;, %2 why</extracomment>
        <translation>%1: %2</translation>
    </message>
</context>
<context>
    <name>marsview::WindowNotices</name>
    <message>
        <source>%1 cannot be placed on the globe: it %2</source>
        <extracomment>%1 is a layer, %2 a reason, such as &quot;has samples beyond a pole&quot;</extracomment>
        <translation>%1 kann nicht auf den Globus gelegt werden: Die Karte %2</translation>
    </message>
    <message>
        <source>Emergency stop: the forces of the haptic device are off</source>
        <translation>Notaus: Die Kräfte des haptischen Geräts sind abgeschaltet</translation>
    </message>
    <message>
        <source>Resume Forces</source>
        <extracomment>On a button: after an emergency stop of the haptic device</extracomment>
        <translation>Kräfte einschalten</translation>
    </message>
    <message>
        <source>Save Diagnostic Log…</source>
        <extracomment>On a button: after a haptic device was lost</extracomment>
        <translation>Diagnoseprotokoll speichern …</translation>
    </message>
    <message>
        <source>Replay Again</source>
        <extracomment>On a button: after a recording of a touch was replayed</extracomment>
        <translation>Nochmals abspielen</translation>
    </message>
    <message>
        <source>Part of the picture is coarse for now. %1</source>
        <extracomment>%1 says which file, and why</extracomment>
        <translation>Ein Teil des Bilds ist vorerst grob. %1</translation>
    </message>
    <message>
        <source>%1 is hidden: its CRS is not that of the flat map. The globe shows both</source>
        <extracomment>%1 is a layer</extracomment>
        <translation>%1 ist verborgen: Das KBS ist nicht das der ebenen Karte. Der Globus zeigt beide</translation>
    </message>
    <message>
        <source>Show Globe</source>
        <extracomment>On a button: show all layers of a body on the globe</extracomment>
        <translation>Globus zeigen</translation>
    </message>
    <message>
        <source>The sample map was closed to show your file</source>
        <translation>Die Beispielkarte wurde geschlossen, um Ihre Datei zu zeigen</translation>
    </message>
    <message>
        <source>The sample map of %1 was closed to show your file</source>
        <translation>Die Beispielkarte von %1 wurde geschlossen, um Ihre Datei zu zeigen</translation>
    </message>
    <message>
        <source>Keep Sample</source>
        <translation>Beispiel behalten</translation>
    </message>
    <message>
        <source>Keep %1</source>
        <translation>%1 behalten</translation>
    </message>
    <message>
        <source>Samples of %1 often mark nodata, but the file declares no nodata value</source>
        <extracomment>%1 is a number</extracomment>
        <translation>Abtastwerte von %1 bedeuten oft Nodata, aber die Datei nennt keinen Nodata-Wert</translation>
    </message>
    <message>
        <source>Set %1 as Nodata</source>
        <extracomment>On a button: read samples of that value as nodata; %1 is a number</extracomment>
        <translation>%1 als Nodata festlegen</translation>
    </message>
    <message>
        <source>Looks like feet, but the file has no unit of elevation: no place on the Earth is as high as %1</source>
        <translation>Sieht nach Fuß aus, aber die Datei hat keine Höheneinheit: Kein Ort der Erde liegt auf %1 Höhe</translation>
    </message>
    <message>
        <source>Looks like feet, but the file has no unit of elevation: no place on the Earth is as low as %1</source>
        <extracomment>%1 is an elevation in meters</extracomment>
        <translation>Sieht nach Fuß aus, aber die Datei hat keine Höheneinheit: Kein Ort der Erde liegt so tief wie %1</translation>
    </message>
    <message>
        <source>The file has no unit of elevation: elevations are read as meters, but the unit of the CRS is the US survey foot</source>
        <translation>Die Datei hat keine Höheneinheit: Höhen werden als Meter gelesen, aber die Einheit des KBS ist der US-Vermessungsfuß</translation>
    </message>
    <message>
        <source>The file has no unit of elevation: elevations are read as meters, but the unit of the CRS is the foot</source>
        <translation>Die Datei hat keine Höheneinheit: Höhen werden als Meter gelesen, aber die Einheit des KBS ist der Fuß</translation>
    </message>
    <message>
        <source>Use US Survey Feet</source>
        <extracomment>On a button: read the elevations of a map in US survey feet</extracomment>
        <translation>US-Vermessungsfuß verwenden</translation>
    </message>
    <message>
        <source>Use Feet</source>
        <translation>Fuß verwenden</translation>
    </message>
    <message>
        <source>Looks like longitude and latitude, but the file has no CRS (%1)</source>
        <extracomment>%1 is a reason, such as &quot;its extent is 0° – 360°, 90° S – 90° N&quot;</extracomment>
        <translation>Sieht nach Länge und Breite aus, aber die Datei hat kein KBS (%1)</translation>
    </message>
    <message>
        <source>Looks like longitude and latitude (%1), but the CRS of the file, %2, is a map projection</source>
        <extracomment>%1 is a reason, such as &quot;its extent is 0° – 360°, 90° S – 90° N&quot;, %2 a CRS</extracomment>
        <translation>Sieht nach Länge und Breite aus (%1), aber das KBS der Datei, %2, ist eine Kartenprojektion</translation>
    </message>
    <message>
        <source>Set Body, CRS…</source>
        <extracomment>On a button: set the body, the CRS, the elevation unit and more of a map</extracomment>
        <translation>Raumbezug festlegen …</translation>
    </message>
    <message>
        <source>WGS 84 (Earth)</source>
        <translation>WGS 84 (Erde)</translation>
    </message>
    <message>
        <source>Use %1</source>
        <extracomment>On a button: read a map in longitude and latitude on that body</extracomment>
        <translation>%1 benutzen</translation>
    </message>
    <message>
        <source>Use…</source>
        <extracomment>On a button that lists bodies: read a map in longitude and latitude on one of them</extracomment>
        <translation>Benutzen …</translation>
    </message>
    <message>
        <source>%1 is shown as a preview. Build its overviews to see and touch all of it</source>
        <extracomment>%1 is a layer</extracomment>
        <translation>%1 wird als Vorschau gezeigt. Erstellen Sie seine Übersichten, um alles zu sehen und zu ertasten</translation>
    </message>
    <message>
        <source>Build Overviews</source>
        <translation>Übersichten erstellen</translation>
    </message>
    <message>
        <source>Try Again</source>
        <extracomment>On a button: build the overviews of a large map after that failed</extracomment>
        <translation>Erneut versuchen</translation>
    </message>
    <message>
        <source>%1 is shown as a preview while its overviews are being built</source>
        <extracomment>%1 is a layer</extracomment>
        <translation>%1 wird als Vorschau gezeigt, während seine Übersichten erstellt werden</translation>
    </message>
    <message>
        <source>Samples of %1 are shown as nodata, although the file declares no nodata value</source>
        <extracomment>%1 is a number</extracomment>
        <translation>Abtastwerte von %1 werden als Nodata gezeigt, obwohl die Datei keinen Nodata-Wert nennt</translation>
    </message>
    <message>
        <source>Show as Elevations</source>
        <extracomment>On a button: show samples that were taken for nodata as elevations</extracomment>
        <translation>Als Höhen zeigen</translation>
    </message>
    <message>
        <source>%1 is shown, one of the %2 rasters in %3</source>
        <translation>%1 wird gezeigt, eines von %2 Rastern in %3</translation>
    </message>
    <message>
        <source>Open %1</source>
        <extracomment>On a button: open another raster of an archive; %1 is its name</extracomment>
        <translation>%1 öffnen</translation>
    </message>
    <message>
        <source>Open Another…</source>
        <extracomment>On a button that lists the other rasters of an archive</extracomment>
        <translation>Weiteres öffnen…</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <extracomment>In a list of rasters: %1 is a name, %2 its size in columns and rows</extracomment>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>%1 × %2</source>
        <extracomment>The columns and rows of a raster</extracomment>
        <translation>%1 × %2</translation>
    </message>
</context>
<context>
    <name>marsview::WorkProgress</name>
    <message>
        <source>Opening %1…</source>
        <extracomment>Shown in the middle of the window while the first map comes; %1 is a file</extracomment>
        <translation>%1 wird geöffnet …</translation>
    </message>
    <message>
        <source>Loading canceled</source>
        <extracomment>In the status bar, for a few seconds</extracomment>
        <translation>Laden abgebrochen</translation>
    </message>
    <message>
        <source>Cannot Open Map</source>
        <translation>Die Karte kann nicht geöffnet werden</translation>
    </message>
    <message>
        <source>map</source>
        <translation>Karte</translation>
    </message>
    <message>
        <source>Saving canceled</source>
        <extracomment>In the status bar, for a few seconds</extracomment>
        <translation>Speichern abgebrochen</translation>
    </message>
    <message>
        <source>Cannot Save Picture</source>
        <translation>Das Bild kann nicht gespeichert werden</translation>
    </message>
    <message>
        <source>&amp;Cancel Saving</source>
        <translation>Speichern abbre&amp;chen</translation>
    </message>
    <message>
        <source>&amp;Cancel Loading</source>
        <translation>Laden abbre&amp;chen</translation>
    </message>
    <message>
        <source>Cannot Record Fly-Through</source>
        <translation>Der Überflug kann nicht aufgezeichnet werden</translation>
    </message>
    <message>
        <source>Cannot Export Report</source>
        <translation>Der Bericht kann nicht exportiert werden</translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation>Abbre&amp;chen</translation>
    </message>
</context>
</TS>
