%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Pentagon
  ! Draws a closed figure on a tilted table, asks the operator where to put it, and draws it again.
  ! While it draws, a timer logs the position of the pen twice a second.
  !
  !   rapidsim run programs/pentagon.mod --answers programs/pentagon.answers.txt

  ! A pen, held beside the flange axis.
  TASK PERS tooldata t4:=[TRUE,[[-105.513,2.40649,246.356],[1,0,0,0]],[0.5,[50,0,50],[1,0,0,0],0,0,0]];

  ! The table is the user frame; the sheet of paper on it is the object frame.
  TASK PERS wobjdata wobj1:=[FALSE,TRUE,"",
    [[559.804,5.50957,-3.63248],[0.999987,-0.00156359,-0.00487101,7.47128E-05]],
    [[5,4,0],[0.67559,0,0,-0.737277]]];

  CONST robtarget p10:=[[-46.86,-7.9,235.64],[0.0498083,-0.0133606,-0.998594,-0.0123139],
    [0,0,1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget p20:=[[-21.39,-34.91,-0.63],[0.0497861,-0.0134405,-0.998589,-0.0127018],
    [0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget p30:=[[19.16,-34.92,-0.53],[0.0498128,-0.0133747,-0.998593,-0.0123192],
    [0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget p40:=[[19.17,35.63,-0.49],[0.0498143,-0.0133815,-0.998593,-0.0123221],
    [0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget p50:=[[-21.65,35.64,-0.22],[0.0498108,-0.0133915,-0.998593,-0.0123259],
    [0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget p60:=[[-21.65,35.64,-0.22],[0.0498136,-0.0133915,-0.998593,-0.0123257],
    [0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];

  VAR num xpos:=0;
  VAR num ypos:=0;
  VAR num zrot:=0;
  VAR num x;
  VAR num y;
  VAR num z;
  VAR robtarget current_pos;
  VAR intnum timer;
  VAR iodev logfile;

  PROC main()
    CONNECT timer WITH Read;
    Open "HOME:" \File:="LOGFILE2.DOC", logfile \Write;
    ITimer 0.5, timer;

    draw;

    TPReadNum xpos, "x of the sheet on the table [mm]?";
    TPReadNum ypos, "y of the sheet on the table [mm]?";
    TPReadNum zrot, "Turn of the sheet about z [deg]?";
    ! Where nobody answers, all three are 0:
    ! the sheet stays where it lies.
    IF xpos<>0 OR ypos<>0 OR zrot<>0 place_sheet;

    ! The configurations that the targets store hold where the sheet lay before.
    ConfJ \Off;
    ConfL \Off;
    draw;

    IDelete timer;
    Close logfile;
  ENDPROC

  ! From above to the first corner, round the figure, and back to where the pen touched down.
  PROC draw()
    MoveJ p10, v200, fine, t4\WObj:=wobj1;
    MoveL p20, v200, z10, t4\WObj:=wobj1;
    MoveL p30, v200, z10, t4\WObj:=wobj1;
    MoveL p40, v200, z10, t4\WObj:=wobj1;
    MoveL p50, v200, z10, t4\WObj:=wobj1;
    MoveL p20, v200, fine, t4\WObj:=wobj1;
  ENDPROC

  TRAP Read
    current_pos := CRobT();
    x := current_pos.trans.x;
    y := current_pos.trans.y;
    z := current_pos.trans.z;
    Write logfile, "X;"\num:=x;
    Write logfile, "Y;"\num:=y;
    Write logfile, "Z;"\num:=z;
  ENDTRAP

  PROC place_sheet()
    wobj1.oframe.trans.x := xpos;
    wobj1.oframe.trans.y := ypos;
    wobj1.oframe.rot := OrientZYX(zrot, 0, 0);
  ENDPROC
ENDMODULE
