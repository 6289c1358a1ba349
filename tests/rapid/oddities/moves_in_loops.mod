! Field practice, Motion: arrays of targets, offsets by loop counters, fine and zones by value.
MODULE moves_in_loops
  CONST robtarget corner:=[[600,-50,500],[0,0,1,0],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget grid{2,2};
  VAR zonedata zone:=[FALSE,1,1,1,0.1,1,0.1];

  PROC main()
    FOR row FROM 1 TO 2 DO
      FOR column FROM 1 TO 2 DO
        grid{row,column}:=Offs(corner,(row-1)*20,(column-1)*20,0);
      ENDFOR
    ENDFOR
    ConfJ\Off;
    ConfL\Off;
    MoveJ grid{1,1},v500,fine,tool0;
    FOR i FROM 1 TO 2 DO
      IF i=2 zone:=z5;
      MoveL grid{i,1},[100,500,5000,1000],zone,tool0;
      MoveL grid{i,2},v100\T:=1,z1\Z:=2,tool0;
    ENDFOR
    MoveL RelTool(grid{1,1},0,0,-10),v50,fine,tool0;
    TPWrite ValToStr(grid{2,2}.trans);    ! -> [620,-30,500]
  ENDPROC
ENDMODULE
