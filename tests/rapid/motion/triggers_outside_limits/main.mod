! RAPID Instructions, TriggIO, TriggEquip, MoveLAO: values that the output never has are refused.
MODULE triggers_outside_limits
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata glue;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    FOR i FROM 1 TO 6 DO
      prepare i;
    ENDFOR
    TPWrite "valid "\Bool:=TriggDataValid(glue);     ! -> valid FALSE
    TPWrite "still at "\Pos:=CPos(\Tool:=tool0);     ! -> still at [700,0,600]
  ENDPROC

  PROC prepare(num way)
    TEST way
    CASE 1:
      TriggIO glue,5\AOp:=aoFlow,11;
    CASE 2:
      TriggEquip glue,5,0.1\AOp:=aoFlow,-1;
    CASE 3:
      TriggRampAO glue,5,0.1,aoFlow,12,20;
    CASE 4:
      TriggIO glue,5\GOp:=goCode,16;
    CASE 5:
      MoveLAO Offs(p1,0,50,0),v500,fine,tool0,aoFlow,11;
    CASE 6:
      MoveLGO Offs(p1,0,50,0),v500,fine,tool0,goCode\Value:=16;
    ENDTEST
    TPWrite "never";
  ERROR
    TEST ERRNO
    CASE ERR_AO_LIM:
      TPWrite "analog "\Num:=way;
      ! -> analog 1
      ! -> analog 2
      ! -> analog 3
      ! -> analog 5
    CASE ERR_GO_LIM:
      TPWrite "group "\Num:=way;
      ! -> group 4
      ! -> group 6
    ENDTEST
    RETURN;
  ENDPROC
ENDMODULE
