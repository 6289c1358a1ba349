MODULE camera
  ! A camera that answers each TRIG after 0.2 s with an offset in y: first 40, then -25, then that there is
  ! no part. The program goes to what it was told; the time from a TRIG to the texts is 0.2 s each.
  CONST robtarget look:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR socketdev eye;
  PROC main()
    VAR string answer;
    VAR num y;
    VAR bool is_number:=TRUE;
    SocketCreate eye;
    SocketConnect eye,"192.168.125.5",5000;
    MoveJ look,v1000,fine,tool0;
    ConfL \Off;
    WHILE is_number DO
      SocketSend eye\Str:="TRIG\0D\0A";
      SocketReceive eye\Str:=answer;
      is_number:=StrToVal(StrPart(answer,1,StrLen(answer)-2),y);
      TPWrite StrPart(answer,1,StrLen(answer)-2);
      IF is_number THEN
        MoveL Offs(look,0,y,0),v500,fine,tool0;
      ENDIF
    ENDWHILE
    SocketClose eye;
  ENDPROC
ENDMODULE
