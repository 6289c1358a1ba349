MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
    lower 1;
  ENDPROC
  PROC lower(num part)
    ConfL\Off; ! found
    IF part=0 RETURN;
    MoveL Offs(p10,0,0,-100),v100,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p10,v500,fine,tool0;
    never_back;
    back_too_late 1;
    in_one_case 2;
  ENDPROC
  PROC never_back()
    SingArea\Wrist;                   ! found
    MoveL p20,v100,fine,tool0;
  ENDPROC
  PROC back_too_late(num part)
    ConfL\Off;                        ! found
    IF part=0 RETURN;
    MoveL p10,v100,fine,tool0;
    ConfL\On;
  ENDPROC
  PROC in_one_case(num part)
    VelSet 50,1000;                   ! found
    PDispSet [[0,0,10],[1,0,0,0]];
    MoveL p10,v100,fine,tool0;
    TEST part
    CASE 1:
      VelSet 100,5000;
    ENDTEST
    PDispOff;
  ENDPROC
ENDMODULE
! ---
MODULE Guarded
  VAR num x := 3;

  PROC main()
    MoveJ [[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
    part;
    part;
  ENDPROC

  PROC part()
    ConfL\Off; ! found
    until_error;
    MoveL [[800,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
  ENDPROC

  ! Ends with the first error of the server.
  PROC until_error()
    serve;
  ERROR
    TPWrite "end";
    TRYNEXT;
  ENDPROC

  PROC serve()
    WHILE TRUE DO
      x := x / (x - 1);
    ENDWHILE
  ENDPROC
ENDMODULE
